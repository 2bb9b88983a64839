// top.hpp - SpinIt's spinning top. [SpinIt, eq. 3, 7; the 2014 form: eq. 8]
#pragma once

#include "problem/spinning.hpp"

namespace kreisel::core {

/// What of a top is lowered beside its inertia ratio: its first moment (height x mass), its height alone, or
/// nothing. The paper's three teapots, 1.68, 1.60 and 1.56.
enum class Lower { mass, height, none };

struct TopOptions {
  double gamma_c = 1;  ///< weight of what is lowered, body units; >= 0
  double gamma_i = 1;  ///< weight of the inertia ratio; > 0
  Lower lower = Lower::mass;
  SpinForm form = SpinForm::trace;
};

/// Minimise  gamma_c (l M)^2 + gamma_i [(Ia/Ic)^2 + (Ib/Ic)^2],  l M = sz, moments about the centre of mass,
/// subject to  sx = sy = 0, sxz = syz = 0.  With Lower::height gamma_c l^2, l = sz / s1, stands in place of
/// the first term. [SpinIt, eq. 3, 7, s. 8 "Rotational stability"]
class Top final : public Spinning {
 public:
  /// @param solid  moments of the solid body, whose least speed the verdict compares with; may be left out
  explicit Top(const TopOptions& options, const std::optional<Moments>& solid = std::nullopt);

  [[nodiscard]] std::string_view name() const override { return "top"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::top; }

  /// As of every spinning problem, and omega_reduction, omega_min(solid) / omega_min: NaN where one of them
  /// does not exist. The solid's is that about its principal axis nearest to z, as if it were balanced.
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override;

 private:
  std::optional<Moments> solid_;
};

[[nodiscard]] Fields<TopOptions> top_fields();
/// @param settings  TopOptions
std::unique_ptr<Problem> make_top(const Settings& settings, const Body& body);

}  // namespace kreisel::core
