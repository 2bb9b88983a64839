// hang.hpp - hung from a point, a body turns until its centre of mass is straight below.
#pragma once

#include "problem/balance.hpp"

namespace kreisel::core {

/// Maximise the mass with the centre of mass on the vertical through a point and no higher than it: balance
/// on a line, and up . (s_xyz - p s1) <= 0. The pose is kept as it hangs, so nothing of it is free.
class Hang final : public Problem {
 public:
  /// @param point  from which it hangs, body frame and units  @param up  of any length but zero
  Hang(const Vec3& point, const Vec3& up);

  [[nodiscard]] std::string_view name() const override { return "hang"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::linear; }
  [[nodiscard]] Traits traits() const override { return on_line_.traits(); }
  [[nodiscard]] double value(const Moments& s) const override { return on_line_.value(s); }
  [[nodiscard]] Moments gradient(const Moments& s) const override { return on_line_.gradient(s); }
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override { return on_line_.hessian(s); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] Vec3 anchor() const override { return on_line_.point(); }

  /// Hangs as posed when the centre of mass is below the point and within 1e-3 L of the vertical through it;
  /// else by how many degrees it turns.
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override;

 private:
  Balance on_line_;
  LinearConstraints constraints_;
};

[[nodiscard]] Fields<LineSettings> hang_fields();
/// @param settings  LineSettings: the point from which it hangs, by default its highest, and which way is up,
///                  by default the model's
std::unique_ptr<Problem> make_hang(const Settings& settings, const Body& body);

/// As rays_of_balance(): the cut stands upright.
[[nodiscard]] std::optional<Vec3> rays_of_hang(const Settings& settings, const Body& body);

}  // namespace kreisel::core
