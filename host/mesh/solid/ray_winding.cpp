#include "mesh/solid/ray_winding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/predicates.hpp"
#include "geometry/triangle.hpp"
#include "stop.hpp"

namespace kreisel::core {

ParallelRays::ParallelRays(const TriangleMesh& mesh, const Vec3& direction)
    : mesh_(mesh),
      direction_(direction),
      u_(direction.unitOrthogonal()),
      v_(direction.normalized().cross(u_)) {
  const std::size_t n = mesh.triangles.size();
  side_ = std::clamp(int(std::sqrt(double(n))), 1, 1024);
  Eigen::Vector2d hi = lo_ = across(mesh.vertices[mesh.triangles[0][0]]);
  double size = 0;
  for (const Vec3& p : mesh.vertices) {
    lo_ = lo_.cwiseMin(across(p));
    hi = hi.cwiseMax(across(p));
    size = std::max(size, p.cwiseAbs().maxCoeff());
  }
  margin_ = 1e-14 * size;
  step_ = ((hi - lo_) / side_).cwiseMax(4 * margin_);
  std::vector<std::array<Cell, 2>> boxes;
  first_.assign(std::size_t(side_) * side_ + 1, 0);
  const auto each_cell = [&](const std::array<Cell, 2>& box, auto&& visit) {
    for (int y = box[0][1]; y <= box[1][1]; ++y)
      for (int x = box[0][0]; x <= box[1][0]; ++x) visit(std::size_t(y) * side_ + x);
  };
  const Eigen::Vector2d margin(margin_, margin_);
  for (const Triangle& t : mesh.triangles) {
    const auto [a, b, c] = corners_of(mesh, t);
    const Eigen::Vector2d p = across(a), q = across(b), r = across(c);
    boxes.push_back(
        {cell_of(p.cwiseMin(q).cwiseMin(r) - margin), cell_of(p.cwiseMax(q).cwiseMax(r) + margin)});
    each_cell(boxes.back(), [&](std::size_t cell) { ++first_[cell + 1]; });
  }
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  in_cell_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t t = 0; t < n; ++t) {
    stop_here(t);
    each_cell(boxes[t], [&](std::size_t cell) { in_cell_[next[cell]++] = t; });
  }
}

Eigen::Vector2d ParallelRays::across(const Vec3& p) const { return {u_.dot(p), v_.dot(p)}; }

ParallelRays::Cell ParallelRays::cell_of(const Eigen::Vector2d& p) const {
  const auto at = [&](int i) {
    const double x = (p[i] - lo_[i]) / step_[i];
    return x > 0 ? int(std::min(x, side_ - 1.0)) : 0;
  };
  return {at(0), at(1)};
}

std::optional<RayCount> ParallelRays::count(const ExactPoint& from) const {
  RayCount found;
  const Cell cell = cell_of(across(from.near()));
  const std::size_t number = std::size_t(cell[1]) * side_ + cell[0];
  for (std::size_t i = first_[number]; i < first_[number + 1]; ++i) {
    const std::uint32_t t = in_cell_[i];
    const auto corners = corners_of(mesh_, mesh_.triangles[t]);
    const auto& [a, b, c] = corners;
    const int ab = passes(from, direction_, a, b), bc = passes(from, direction_, b, c);
    if (ab * bc < 0) continue;
    const int ca = passes(from, direction_, c, a);
    if (ab * ca < 0 || bc * ca < 0) continue;
    if (ab == 0 || bc == 0 || ca == 0) {
      if (projection_axis(a, b, c) < 0) continue;  // of no face
      return {};
    }
    // All three are the sign of direction . normal.
    const int side = orient3d(corners, from);
    if (side == 0) found.here.push_back(t);
    if (side * ab < 0) found.ahead += ab;
  }
  return found;
}

}  // namespace kreisel::core
