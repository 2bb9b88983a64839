// reach.hpp - the points within a distance of an edge or a triangle, along vertical lines.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/query/offset.hpp"

/// Every shape says where it lies, never too little (rows: a range of y; columns: a range of x in a row), and
/// which part of a vertical line it holds (none: not z0 < z1).
namespace kreisel::core::reach {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Below this a direction counts as horizontal (or vertical): quotients stay finite. It is so small that a
/// line as long as a double can tell stays on the same side.
inline constexpr double no_slope = 1e-100;

/// A rectangle in the xy-plane along any direction: what a shape's shadow lies in.
struct Footprint {
  double x = 0, y = 0;         ///< of a point that the ranges count from
  double ux = 1, uy = 0;       ///< unit vector
  double along[2], across[2];  ///< ranges along u, and along u turned to the left

  /// u along (x, y), or along the x-axis when that has no direction.
  void head(double hx, double hy);
  [[nodiscard]] std::pair<double, double> rows() const;
  [[nodiscard]] std::pair<double, double> columns(double row) const;
};

/// Half-spaces, each solved for z: a line costs two products a half-space.
class HalfSpaces {
 public:
  explicit HalfSpaces(const Vec3& origin) : origin_(origin) {}

  /// normal . (p - origin) + offset >= 0. Five at most.
  void require(const Vec3& normal, double offset);

  [[nodiscard]] Span span(double x, double y) const {
    const double dx = x - origin_[0], dy = y - origin_[1];
    Span s{-infinity, infinity};
    for (int k = 0; k < beside_count_; ++k)
      if (beside_[k](dx, dy) < 0) return {0, 0};
    for (int k = 0; k < above_count_; ++k) s.z0 = std::max(s.z0, above_[k](dx, dy));
    for (int k = 0; k < below_count_; ++k) s.z1 = std::min(s.z1, below_[k](dx, dy));
    return s;
  }

 private:
  struct Linear {
    double base, x, y;
    double operator()(double dx, double dy) const { return base + x * dx + y * dy; }
  };
  Vec3 origin_;
  int above_count_ = 0, below_count_ = 0, beside_count_ = 0;
  std::array<Linear, 5> above_{}, below_{}, beside_{};
};

/// The points within a distance of an edge, between the planes across its ends.
class Cylinder {
 public:
  /// a != b
  Cylinder(const Vec3& a, const Vec3& b, double radius);
  [[nodiscard]] std::pair<double, double> rows() const { return shadow_.rows(); }
  [[nodiscard]] std::pair<double, double> columns(double y) const { return shadow_.columns(y); }
  [[nodiscard]] Span span(double x, double y) const {
    const double dx = x - a_[0], dy = y - a_[1];
    const double aside = shadow_.ux * dy - shadow_.uy * dx, along = shadow_.ux * dx + shadow_.uy * dy;
    if (run_ == 0) return dx * dx + dy * dy < radius_ * radius_ ? ends_.span(x, y) : Span{0, 0};
    const double square = radius_ * radius_ - aside * aside;
    if (!(square > 0)) return {0, 0};
    const double half = std::sqrt(square);
    Span s = ends_.span(x, y);
    s.z0 = std::max(s.z0, a_[2] + (rise_ * along - half) / run_);
    s.z1 = std::min(s.z1, a_[2] + (rise_ * along + half) / run_);
    return s;
  }

 private:
  Vec3 a_;
  double radius_;
  double run_ = 0, rise_ = 1;  ///< of the edge's unit vector, horizontally and vertically
  HalfSpaces ends_;
  Footprint shadow_;
};

/// The points within a distance of a triangle, above or below it.
class Prism {
 public:
  Prism(const Vec3& a, const Vec3& b, const Vec3& c, double radius);
  [[nodiscard]] bool flat() const { return flat_; }  ///< no area: nothing else may be asked
  [[nodiscard]] std::pair<double, double> rows() const { return shadow_.rows(); }
  [[nodiscard]] std::pair<double, double> columns(double y) const { return shadow_.columns(y); }
  [[nodiscard]] Span span(double x, double y) const { return sides_.span(x, y); }

 private:
  bool flat_ = false;
  HalfSpaces sides_;
  Footprint shadow_;
};

}  // namespace kreisel::core::reach
