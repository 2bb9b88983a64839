// swept_pair.hpp - does a triangle of A stand in the way of a triangle of T(B)?
#pragma once

#include <optional>

#include "nest/decide/nesting.hpp"

namespace kreisel::core::nest {

/// Coordinates of one half.
[[nodiscard]] inline HalfView view_of(const Cut& cut, int half) {
  return {cut.into(half), cut.removal(half)};
}

/// What a triangle T of T(B) sweeps on the way to the cut: every x beyond the plane with x + t a in T for
/// some t >= 0. A prism with a slanting top, closed. [Nest, s. 3]
class SweptTriangle {
 public:
  /// Corners in the half's coordinates.
  SweptTriangle(const HalfView& view, const Vec3& p, const Vec3& q, const Vec3& r);

  /// Whether it is seen edge-on: then it sweeps no more than the edges it shares with its neighbours, and is
  /// left to them.
  [[nodiscard]] bool edge_on() const { return edge_on_; }
  /// A point that the prism has in common with a closed triangle, if there is one; touching counts. Computed
  /// in double by clipping the triangle, so right up to round-off in the coordinates.
  [[nodiscard]] std::optional<Vec3> common_point(const Vec3& a, const Vec3& b, const Vec3& c) const;
  /// The point of T above a point of the prism. Not edge-on.
  [[nodiscard]] Vec3 top(const Vec3& x) const { return x + Vec3(0, 0, sides_[3](x) / -sides_[3].inward.z()); }

 private:
  struct HalfSpace {
    Vec3 inward, at;
    double operator()(const Vec3& x) const { return inward.dot(x - at); }
  };
  HalfSpace sides_[5];  ///< three walls, top, cut
  bool edge_on_;
};

}  // namespace kreisel::core::nest
