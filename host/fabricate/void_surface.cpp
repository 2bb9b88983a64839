#include "fabricate/void_surface.hpp"

#include <array>
#include <unordered_map>

namespace kreisel::core {
namespace {

/// Void flags over the whole grid; cells outside it count as solid.
class VoidCells {
 public:
  explicit VoidCells(const VoxelSet& solid)
      : n_(solid.domain().grid.n), cells_(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2]) {
    const auto& intervals = solid.domain().intervals;
    for (std::size_t i = 0; i < intervals.size(); ++i)
      for (int k = intervals[i].k0; k < intervals[i].k1; ++k)
        if (!solid.solid(solid.first(i) + static_cast<std::size_t>(k - intervals[i].k0)))
          cells_[at({intervals[i].ix, intervals[i].iy, k})] = true;
  }

  [[nodiscard]] bool operator()(const std::array<int, 3>& c) const {
    for (int a = 0; a < 3; ++a)
      if (c[a] < 0 || c[a] >= n_[a]) return false;
    return cells_[at(c)];
  }

 private:
  [[nodiscard]] std::size_t at(const std::array<int, 3>& c) const {
    return (static_cast<std::size_t>(c[2]) * n_[1] + c[1]) * n_[0] + c[0];
  }

  std::array<int, 3> n_;
  std::vector<bool> cells_;
};

/// Corners of the grid that the surface uses, numbered as they come.
class Corners {
 public:
  explicit Corners(const Grid& grid) : grid_(grid) {}

  std::uint32_t operator()(const std::array<int, 3>& corner) {
    const std::uint64_t key = (static_cast<std::uint64_t>(corner[2]) << 40) |
                              (static_cast<std::uint64_t>(corner[1]) << 20) |
                              static_cast<std::uint64_t>(corner[0]);
    const auto [where, fresh] = index_.try_emplace(key, static_cast<std::uint32_t>(vertices_.size()));
    if (fresh)
      vertices_.emplace_back(grid_.face(0, corner[0]), grid_.face(1, corner[1]), grid_.face(2, corner[2]));
    return where->second;
  }

  std::vector<Vec3> take() { return std::move(vertices_); }

 private:
  const Grid& grid_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_;
  std::vector<Vec3> vertices_;
};

}  // namespace

TriangleMesh void_surface(const VoxelSet& solid) {
  const Columns& domain = solid.domain();
  const VoidCells is_void(solid);
  Corners corner(domain.grid);
  TriangleMesh mesh;

  // The face of `cell` across `axis` on its upper or lower side, seen from the void counter-clockwise.
  const auto add_face = [&](std::array<int, 3> cell, int axis, bool upper) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (upper) ++cell[axis];
    std::array<std::uint32_t, 4> ring;
    for (int i = 0; i < 4; ++i) {
      std::array<int, 3> c = cell;
      c[u] += i == 1 || i == 2;
      c[v] += i >= 2;
      ring[i] = corner(c);
    }
    // The ring runs counter-clockwise about +axis; the normal has to point into the void, away from the face.
    if (upper) std::swap(ring[1], ring[3]);
    mesh.triangles.push_back({ring[0], ring[1], ring[2]});
    mesh.triangles.push_back({ring[0], ring[2], ring[3]});
  };

  for (const Interval& run : domain.intervals)
    for (int k = run.k0; k < run.k1; ++k) {
      const std::array<int, 3> cell = {run.ix, run.iy, k};
      if (!is_void(cell)) continue;
      for (int axis = 0; axis < 3; ++axis)
        for (const bool upper : {false, true}) {
          std::array<int, 3> neighbour = cell;
          neighbour[axis] += upper ? 1 : -1;
          if (!is_void(neighbour)) add_face(cell, axis, upper);
        }
    }
  mesh.vertices = corner.take();
  return mesh;
}

}  // namespace kreisel::core
