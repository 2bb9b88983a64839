#include "mesh/make/refine.hpp"

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "stop.hpp"

namespace kreisel::core {
namespace {

constexpr std::uint32_t none = ~0u;

/// The edges to split and the middles of them, each made once.
class Middles {
 public:
  explicit Middles(TriangleMesh& mesh) : mesh_(mesh) {}

  [[nodiscard]] bool empty() const { return known_.empty(); }
  [[nodiscard]] bool has(std::uint32_t a, std::uint32_t b) const { return known_.contains(key(a, b)); }
  /// @return  whether it is a new one
  bool add(std::uint32_t a, std::uint32_t b) { return known_.try_emplace(key(a, b), none).second; }
  /// Of an edge that is to be split; none of another.
  std::uint32_t at(std::uint32_t a, std::uint32_t b) {
    const auto found = known_.find(key(a, b));
    if (found == known_.end()) return none;
    if (found->second == none) {
      found->second = static_cast<std::uint32_t>(mesh_.vertices.size());
      mesh_.vertices.push_back((mesh_.vertices[a] + mesh_.vertices[b]) / 2);
    }
    return found->second;
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }
  TriangleMesh& mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> known_;
};

/// Which of a triangle's sides is the longest; of equal ones by their ends, as from both sides of an edge.
std::size_t longest_side(const TriangleMesh& mesh, const Triangle& t) {
  const auto length = [&](std::size_t i) {
    const std::uint32_t a = t[i], b = t[(i + 1) % 3];
    return std::tuple((mesh.vertices[a] - mesh.vertices[b]).squaredNorm(), std::min(a, b), std::max(a, b));
  };
  std::size_t longest = 0;
  for (const std::size_t i : {1u, 2u})
    if (length(i) > length(longest)) longest = i;
  return longest;
}

/// Where a side of a triangle is split, so is its longest: then no angle gets much smaller.
void add_longest_sides(const TriangleMesh& mesh, Middles& middles) {
  std::vector<std::uint32_t> whole(mesh.triangles.size());  // none of whose sides is split so far
  for (std::uint32_t i = 0; i < whole.size(); ++i) whole[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    std::erase_if(whole, [&](std::uint32_t i) {
      stop_here(i);
      const Triangle& t = mesh.triangles[i];
      if (!middles.has(t[0], t[1]) && !middles.has(t[1], t[2]) && !middles.has(t[2], t[0])) return false;
      const std::size_t k = longest_side(mesh, t);
      changed |= middles.add(t[k], t[(k + 1) % 3]);
      return true;
    });
  }
}

/// A triangle of which the side from `a` to `b`, its longest, is split, and perhaps the others.
void split(std::uint32_t a, std::uint32_t b, std::uint32_t c, Middles& middles,
           std::vector<Triangle>& triangles) {
  const std::uint32_t ab = middles.at(a, b);
  const auto half = [&](std::uint32_t from, std::uint32_t to) {  // of the two that lie beside its median
    const std::uint32_t middle = middles.at(from, to);
    if (middle == none) {
      triangles.push_back({ab, from, to});
    } else {
      triangles.push_back({ab, from, middle});
      triangles.push_back({ab, middle, to});
    }
  };
  half(b, c);
  half(c, a);
}

}  // namespace

void split_edges(TriangleMesh& mesh, const std::function<bool(const Vec3&, const Vec3&)>& too_long) {
  for (;;) {
    Middles middles(mesh);
    for (const Triangle& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = t[i], b = t[(i + 1) % 3];
        stop_here();
        if (too_long(mesh.vertices[a], mesh.vertices[b])) (void)middles.add(a, b);
      }
    if (middles.empty()) return;
    add_longest_sides(mesh, middles);
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
      const std::size_t k = longest_side(mesh, t);
      if (middles.has(t[k], t[(k + 1) % 3]))
        split(t[k], t[(k + 1) % 3], t[(k + 2) % 3], middles, triangles);
      else
        triangles.push_back(t);
    }
    mesh.triangles = std::move(triangles);
  }
}

}  // namespace kreisel::core
