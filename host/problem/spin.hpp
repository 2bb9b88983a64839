// spin.hpp - RayRep's spinning problem.
#pragma once

#include "problem/problem.hpp"

namespace kreisel {

struct SpinOptions {
  double lambda = 0;   ///< weight of the height of the centre of mass, per body length; >= 0
  double gamma_i = 1;  ///< weight of the inertia ratio; > 0
};

/// Minimise  lambda c_z + gamma_i (Jxx^2 + Jyy^2 + 2 Ixy^2) / Izz^2,  Jtt = Itt - sz^2/s1,
/// subject to  sx = sy = 0, sxz = syz = 0.  [RayRep, eq. 7-9; Izz enters squared]
///
/// J is the upper 2 x 2 block of the inertia tensor about the centre of mass when that lies on the axis.
class Spin final : public Problem {
 public:
  explicit Spin(const SpinOptions& options);

  [[nodiscard]] const SpinOptions& options() const { return options_; }
  [[nodiscard]] std::string_view name() const override { return "spin"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::spin; }
  [[nodiscard]] double value(const Moments& s) const override;
  [[nodiscard]] Moments gradient(const Moments& s) const override;
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override;
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }

  /// Centre of mass off the axis <= 1e-3 L, axis tilt <= 0.1 degrees, Izz the largest principal moment about
  /// the centre of mass. omega_min_rpm from SpinIt's eq. 1, NaN when Izz is not the largest or the centre of
  /// mass lies below the contact point (any speed will do).
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override;

 private:
  SpinOptions options_;
  LinearConstraints constraints_;
};

/// @throws InputError  a setting other than lambda, gamma_i, or out of range
std::unique_ptr<Problem> make_spin(const ProblemSettings& settings, const Body& body);

}  // namespace kreisel
