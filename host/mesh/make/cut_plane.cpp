#include "mesh/make/cut_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "error.hpp"

namespace kreisel::core {
namespace {

/// A height at or just above the one asked for that no vertex comes near to.
double clear_height(const TriangleMesh& mesh, double height) {
  const double clearance = 1e-8 * bounding_box(mesh).extent().norm();
  std::vector<double> near;
  for (const Vec3& v : mesh.vertices)
    if (v[2] > height - clearance) near.push_back(v[2]);
  std::ranges::sort(near);
  for (const double z : near) {
    if (z >= height + clearance) break;
    height = z + 1.5 * clearance;
  }
  return height;
}

class Cut {
 public:
  Cut(const TriangleMesh& solid, double height, const WrittenAs& written)
      : solid_(solid), height_(height), written_(written) {}

  /// What lies above, open; and of its rim the edges as the cap runs along them.
  void keep_above() {
    for (const Triangle& t : solid_.triangles) {
      std::array<bool, 3> up{};
      for (std::size_t i = 0; i < 3; ++i) up[i] = solid_.vertices[t[i]][2] > height_;
      const int count = up[0] + up[1] + up[2];
      if (count == 3) out.triangles.push_back({kept(t[0]), kept(t[1]), kept(t[2])});
      if (count == 0 || count == 3) continue;
      // Turned so that the first corner is the one alone on its side.
      const bool alone = count == 1;
      const std::size_t i = static_cast<std::size_t>(std::ranges::find(up, alone) - up.begin());
      const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      const std::uint32_t ab = crossing(a, b), ac = crossing(a, c);
      if (alone) {
        if (ab == ac) continue;
        out.triangles.push_back({kept(a), ab, ac});
        rim[ac] = ab;
      } else {
        const std::uint32_t kept_b = kept(b), kept_c = kept(c);
        out.triangles.push_back({ab, kept_b, kept_c});
        if (ab == ac) continue;
        out.triangles.push_back({ab, kept_c, ac});
        rim[ab] = ac;
      }
    }
  }

  [[nodiscard]] double height() const { return height_; }

  TriangleMesh out;
  std::map<std::uint32_t, std::uint32_t> rim;

 private:
  std::uint32_t kept(std::uint32_t vertex) {
    const auto [entry, fresh] = kept_.try_emplace(vertex, static_cast<std::uint32_t>(out.vertices.size()));
    if (fresh) out.vertices.push_back(solid_.vertices[vertex]);
    return entry->second;
  }
  std::uint32_t crossing(std::uint32_t a, std::uint32_t b) {
    const auto ends = std::minmax(a, b);
    const auto [entry, fresh] = crossings_.try_emplace(ends, static_cast<std::uint32_t>(out.vertices.size()));
    if (fresh) {
      const Vec3 &low = solid_.vertices[ends.first], &high = solid_.vertices[ends.second];
      Vec3 at = low + (height_ - low[2]) / (high[2] - low[2]) * (high - low);
      at[2] = height_;
      if (written_.rounded) {
        at = written_.rounded(at);
        entry->second = rounded_.try_emplace({at[0], at[1], at[2]}, entry->second).first->second;
      }
      if (entry->second == out.vertices.size()) out.vertices.push_back(at);
    }
    return entry->second;
  }

  const TriangleMesh& solid_;
  double height_;
  const WrittenAs& written_;
  std::map<std::array<double, 3>, std::uint32_t> rounded_;
  std::map<std::uint32_t, std::uint32_t> kept_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings_;
};

/// Walls and bottom of a hole whose mouth is `ring`, material outside.
void add_hole(TriangleMesh& mesh, const Loop& ring, double depth) {
  const auto n = static_cast<std::uint32_t>(ring.size()),
             bottom = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const std::uint32_t v : ring) mesh.vertices.push_back(mesh.vertices[v] + Vec3(0, 0, depth));
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.triangles.push_back({ring[i], bottom + j, ring[j]});
    mesh.triangles.push_back({ring[i], bottom + i, bottom + j});
  }
  for (std::uint32_t i = 1; i + 1 < n; ++i) mesh.triangles.push_back({bottom, bottom + i + 1, bottom + i});
}

}  // namespace

TriangleMesh above_plane(const TriangleMesh& solid, double height, const BlindHole& hole) {
  return above_plane(solid, height, std::span(&hole, 1));
}

TriangleMesh above_plane(const TriangleMesh& solid, double height, std::span<const BlindHole> holes,
                         const WrittenAs& written) {
  Cut cut(solid, clear_height(solid, height), written);
  cut.keep_above();
  TriangleMesh& out = cut.out;
  if (out.triangles.empty()) return out;

  // The cap looks down: seen from below, as by (y, x), its outer loops run counter-clockwise.
  std::vector<Loop> loops = loops_along(std::move(cut.rim));
  const std::vector<Loop> sections = loops;
  std::vector<Loop> rings;
  for (const BlindHole& hole : holes) {
    Loop& ring = rings.emplace_back();
    for (const Vec2& p : hole.polygon) {
      ring.push_back(static_cast<std::uint32_t>(out.vertices.size()));
      const Vec3 at(p[0], p[1], cut.height());
      out.vertices.push_back(written.rounded ? written.rounded(at) : at);
    }
  }
  Polygon flat;
  for (const Vec3& v : out.vertices) flat.push_back(written.flat ? written.flat(v) : Vec2(v[1], v[0]));
  for (const Loop& ring : rings) {
    if (ring.empty()) continue;
    const auto around = std::ranges::count_if(
        sections, [&](const Loop& loop) { return contains(polygon_of(flat, loop), flat[ring.front()]); });
    if (around % 2 == 0)
      throw InputError("a hole in the cut of the mesh would lie in air; expected material all around it");
    loops.push_back(ring);
  }

  for (const Triangle& t : fill_loops(flat, loops)) out.triangles.push_back(t);
  for (std::size_t i = 0; i < holes.size(); ++i)
    if (!rings[i].empty()) add_hole(out, rings[i], holes[i].depth);
  return out;
}

}  // namespace kreisel::core
