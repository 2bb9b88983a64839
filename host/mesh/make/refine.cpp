#include "mesh/make/refine.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace kreisel::core {
namespace {

/// The middles of split edges, each made once.
class Middles {
 public:
  Middles(TriangleMesh& mesh, const std::function<bool(const Vec3&, const Vec3&)>& too_long)
      : mesh_(mesh), too_long_(too_long) {}

  std::optional<std::uint32_t> operator()(std::uint32_t a, std::uint32_t b) {
    const auto [entry, fresh] = known_.try_emplace(std::minmax(a, b));
    if (fresh && too_long_(mesh_.vertices[a], mesh_.vertices[b])) {
      entry->second = static_cast<std::uint32_t>(mesh_.vertices.size());
      mesh_.vertices.push_back((mesh_.vertices[a] + mesh_.vertices[b]) / 2);
    }
    return entry->second;
  }

 private:
  TriangleMesh& mesh_;
  const std::function<bool(const Vec3&, const Vec3&)>& too_long_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::optional<std::uint32_t>> known_;
};

}  // namespace

void split_edges(TriangleMesh& mesh, const std::function<bool(const Vec3&, const Vec3&)>& too_long) {
  for (bool changed = true; changed;) {
    changed = false;
    Middles middle(mesh, too_long);
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
      std::array<std::optional<std::uint32_t>, 3> m;
      for (std::size_t i = 0; i < 3; ++i) m[i] = middle(t[i], t[(i + 1) % 3]);
      const auto split = std::ranges::count_if(m, [](const auto& at) { return at.has_value(); });
      changed |= split > 0;
      if (split == 0) {
        triangles.push_back(t);
      } else if (split == 3) {
        for (std::size_t i = 0; i < 3; ++i) triangles.push_back({t[i], *m[i], *m[(i + 2) % 3]});
        triangles.push_back({*m[0], *m[1], *m[2]});
      } else {
        // Turned so that the first edge is split, and of two the third is not.
        std::size_t i = 0;
        while (!m[i] || (split == 2 && m[(i + 2) % 3])) ++i;
        const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3], ab = *m[i];
        if (split == 1) {
          triangles.push_back({a, ab, c});
          triangles.push_back({ab, b, c});
        } else {
          const std::uint32_t bc = *m[(i + 1) % 3];
          triangles.push_back({ab, b, bc});
          triangles.push_back({a, ab, bc});
          triangles.push_back({a, bc, c});
        }
      }
    }
    mesh.triangles = std::move(triangles);
  }
}

}  // namespace kreisel::core
