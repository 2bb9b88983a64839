// yoyo.hpp - SpinIt's yo-yo. [SpinIt, eq. 2, 5; the 2014 form: eq. 6]
#pragma once

#include "problem/spinning.hpp"

namespace kreisel::core {

struct YoyoOptions {
  double gamma_i = 1;  ///< > 0; changes f, not where it is least
  SpinForm form = SpinForm::trace;
};

/// Minimise  gamma_i [(Ia/Ic)^2 + (Ib/Ic)^2]  subject to  sx = sy = sz = 0, sxz = syz = 0 about the centre q
/// of the axle, which is the origin.
///
/// With sz = 0 the lateral moments are linear in s, and f is a convex sum of squares over the square of a
/// positive linear form: pseudoconvex, so that a stationary point is the minimum.
class Yoyo final : public Spinning {
 public:
  explicit Yoyo(const YoyoOptions& options) : Spinning({.gamma_i = options.gamma_i}, true, options.form) {}

  [[nodiscard]] std::string_view name() const override { return "yoyo"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::pseudoconvex; }
};

[[nodiscard]] Fields<YoyoOptions> yoyo_fields();
/// @param settings  YoyoOptions
/// @throws InputError  a centre of the axle outside the body's hull
std::unique_ptr<Problem> make_yoyo(const Settings& settings, const Body& body);

}  // namespace kreisel::core
