// ray_winding.hpp - what a ray passes, with signs, on its way out of a closed surface.
#pragma once

#include <optional>
#include <vector>

#include "geometry/exact_point.hpp"

namespace kreisel::core {

/// Of a point: how the triangles lie ahead of it and about it.
struct RayCount {
  int ahead = 0;                    ///< triangles passed from their back to their front, less the others
  std::vector<std::uint32_t> here;  ///< triangles that hold the point, ascending
};

/// Rays in one direction through the triangles of a mesh, which are sorted by where they lie across it.
class ParallelRays {
 public:
  /// @param mesh  outlives this
  ParallelRays(const TriangleMesh& mesh, const Vec3& direction);

  [[nodiscard]] const Vec3& direction() const { return direction_; }
  /// Exact. Nothing where the ray's line meets an edge or lies in a triangle. O(triangles near the line).
  [[nodiscard]] std::optional<RayCount> count(const ExactPoint& from) const;

 private:
  using Cell = std::array<int, 2>;
  [[nodiscard]] Eigen::Vector2d across(const Vec3& p) const;
  [[nodiscard]] Cell cell_of(const Eigen::Vector2d& p) const;

  const TriangleMesh& mesh_;
  Vec3 direction_, u_, v_;
  Eigen::Vector2d lo_ = {0, 0}, step_ = {1, 1};
  double margin_ = 0;  ///< more than rounding can move a point across
  int side_ = 1;
  std::vector<std::uint32_t> first_,
      in_cell_;  ///< triangles of cell i: in_cell_[first_[i]] to [first_[i + 1]]
};

}  // namespace kreisel::core
