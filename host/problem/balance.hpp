// balance.hpp - centre of mass at a point or on a line.
#pragma once

#include <optional>

#include "problem/problem.hpp"

namespace kreisel::core {

/// Maximise the mass with the centre of mass at a point p, or on the line through p: e . (s_xyz - p s1) = 0
/// for every direction e (across the line). Linear; what is left out lies beyond a plane, on which side of a
/// ray is not known beforehand.
class Balance final : public Problem {
 public:
  /// @param point      body frame and units
  /// @param direction  of the line; nothing: the centre of mass is to be at the point itself
  Balance(const Vec3& point, const std::optional<Vec3>& direction);

  [[nodiscard]] const Vec3& point() const { return point_; }
  [[nodiscard]] const std::optional<Vec3>& direction() const { return direction_; }  ///< of unit length

  [[nodiscard]] std::string_view name() const override { return "balance"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::linear; }
  [[nodiscard]] Traits traits() const override { return {Filling::either_end}; }
  [[nodiscard]] double value(const Moments& s) const override { return -s[S1]; }
  [[nodiscard]] Moments gradient(const Moments&) const override { return -Moments::Unit(S1); }
  [[nodiscard]] Matrix10 hessian(const Moments&) const override { return Matrix10::Zero(); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] Vec3 anchor() const override { return point_; }

  /// Balanced when the centre of mass is within 1e-3 L of the point or line.
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override;

 private:
  Vec3 point_;
  std::optional<Vec3> direction_;
  LinearConstraints constraints_;
};

/// Model coordinates, mm.
struct LineSettings {
  std::optional<Vec3> point;
  std::optional<Vec3> line;  ///< direction of a line through it; not zero
};

[[nodiscard]] Fields<LineSettings> balance_fields();
/// Of these two settings. @param point, line  what they say here, for help
[[nodiscard]] Fields<LineSettings> line_fields(std::string_view point, std::string_view line);

/// @param settings  LineSettings, with a point; without a line at the point itself
/// @throws InputError  no point
std::unique_ptr<Problem> make_balance(const Settings& settings, const Body& body);

}  // namespace kreisel::core
