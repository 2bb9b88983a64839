// spin.hpp - RayRep's spinning problem.
#pragma once

#include "problem/spinning.hpp"

namespace kreisel::core {

struct SpinOptions {
  double lambda = 0;   ///< weight of the height of the centre of mass, per body length; >= 0
  double gamma_i = 1;  ///< weight of the inertia ratio; > 0
};

/// Minimise  lambda c_z + gamma_i (Jxx^2 + Jyy^2 + 2 Ixy^2) / Izz^2,  Jtt = Itt - sz^2/s1,
/// subject to  sx = sy = 0, sxz = syz = 0.  [RayRep, eq. 7-9]
class Spin final : public Spinning {
 public:
  explicit Spin(const SpinOptions& options)
      : Spinning({.lambda = options.lambda, .gamma_i = options.gamma_i}, false, SpinForm::trace) {}

  [[nodiscard]] std::string_view name() const override { return "spin"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::spin; }
};

[[nodiscard]] Fields<SpinOptions> spin_fields();
/// @param settings  SpinOptions
std::unique_ptr<Problem> make_spin(const Settings& settings, const Body& body);

}  // namespace kreisel::core
