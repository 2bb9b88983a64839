// box.hpp - axis-aligned boxes, in the plane and in space.
#pragma once

#include <Eigen/Core>
#include <limits>

namespace kreisel::core {

/// Empty until a point is added.
template <int N>
struct BoxOf {
  using Point = Eigen::Matrix<double, N, 1>;

  Point lo = Point::Constant(std::numeric_limits<double>::infinity()), hi = -lo;

  void add(const Point& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  [[nodiscard]] Point extent() const { return hi - lo; }
  [[nodiscard]] Point centre() const { return (lo + hi) / 2; }
  [[nodiscard]] bool within(const BoxOf& outer) const {
    return (lo.array() >= outer.lo.array()).all() && (hi.array() <= outer.hi.array()).all();
  }
};

using Box = BoxOf<3>;

/// Of a range of points.
template <class Points>
[[nodiscard]] auto bounding_box(const Points& points) {
  BoxOf<Points::value_type::RowsAtCompileTime> box;
  for (const auto& p : points) box.add(p);
  return box;
}

}  // namespace kreisel::core
