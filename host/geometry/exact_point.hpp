// exact_point.hpp - points that no double holds: where edges, planes and segments meet.
#pragma once

#include <gmpxx.h>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Three rational numbers over one denominator, and doubles within 2^-52 of them.
class ExactPoint {
 public:
  explicit ExactPoint(const Vec3& p);
  explicit ExactPoint(const std::array<mpq_class, 3>& p);

  /// Numerators and their denominator, which is positive; without a common divisor.
  [[nodiscard]] const std::array<mpz_class, 4>& homogeneous() const { return homogeneous_; }
  [[nodiscard]] std::array<mpq_class, 3> exact() const;
  [[nodiscard]] const Vec3& near() const { return near_; }
  [[nodiscard]] bool operator==(const ExactPoint& other) const {
    return near_ == other.near_ && homogeneous_ == other.homogeneous_;
  }
  /// By the coordinates in turn.
  [[nodiscard]] bool operator<(const ExactPoint& other) const;
  /// The nearest doubles, or the nearest numbers in single precision.
  [[nodiscard]] Vec3 rounded(bool to_single) const;

 private:
  std::array<mpz_class, 4> homogeneous_;
  Vec3 near_;
};

/// orient2d() of the points without coordinate `axis` (predicates.hpp).
[[nodiscard]] int orient2d(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, int axis);

/// orient3d() of a triangle and a point (predicates.hpp).
[[nodiscard]] int orient3d(const std::array<Vec3, 3>& triangle, const ExactPoint& p);

/// Sign of direction . ((a - p) x (b - p)): which way round the line through p passes the edge from a to b.
[[nodiscard]] int passes(const ExactPoint& p, const Vec3& direction, const Vec3& a, const Vec3& b);

/// Whether b lies on the segment from a to c, all three on one line.
[[nodiscard]] bool between(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c);

/// Where the line through p and q meets the plane of the triangle, which is not parallel to it.
[[nodiscard]] ExactPoint line_meets_plane(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& triangle);

/// Where the lines a b and c d meet, of four points in one plane that do not fall together without coordinate
/// `axis`. The lines are not parallel.
[[nodiscard]] ExactPoint lines_meet(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c,
                                    const ExactPoint& d, int axis);

/// The mean of three points.
[[nodiscard]] ExactPoint middle_of(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c);

}  // namespace kreisel::core
