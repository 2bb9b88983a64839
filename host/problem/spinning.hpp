// spinning.hpp - what spin, top and yo-yo have in common: objective, constraints, verdict.
#pragma once

#include <memory>
#include <optional>

#include "problem/problem.hpp"
#include "settings/field_text.hpp"

namespace kreisel::core {

/// f(s) = lambda c_z + height c_z^2 + moment sz^2 + gamma_i R^2,   R^2 = (Jxx^2 + Jyy^2 + 2 sxy^2) / Izz^2,
///
/// c_z = sz / s1, Jxx = syy + szz - sz^2/s1, Jyy likewise with sxx, Izz = sxx + syy. J is the upper 2 x 2
/// block of the inertia tensor about the centre of mass when that lies on the axis, so R^2 = tr(J^2) / Izz^2
/// = (Ia/Ic)^2 + (Ib/Ic)^2, if z is principal. [SpinIt 2017, eq. 5; RayRep, eq. 7-8; Izz enters squared]
struct SpinWeights {
  double lambda = 0;   ///< of the height of the centre of mass [RayRep]; >= 0
  double height = 0;   ///< of its square; >= 0
  double moment = 0;   ///< of (height x mass)^2 [SpinIt, eq. 3]; >= 0
  double gamma_i = 1;  ///< of the inertia ratio; > 0

  [[nodiscard]] double value(const Moments& s) const;
  [[nodiscard]] Moments gradient(const Moments& s) const;
  [[nodiscard]] Matrix10 hessian(const Moments& s) const;
};

/// How the lateral moments enter: `trace`, as tr(J^2) [SpinIt 2017]; `angle`, as those about axes that an
/// angle phi turns, a variable of its own [SpinIt 2014, eq. 6]: the same problem, see principal_angle.hpp.
enum class SpinForm { trace, angle };

/// Settings that several kinds of it have.
template <class Options>
[[nodiscard]] Field<Options> inertia_weight_field() {
  return {"gamma_i", "", "weight of the inertia ratio; default 1",
          [](auto& o, auto k, auto v) { o.gamma_i = field_text::positive(k, v); },
          [](auto& o) { return field_text::number_text(o.gamma_i); }};
}
template <class Options>
[[nodiscard]] Field<Options> form_field() {
  return field_text::one_of<Options>(
      "form", "how the lateral moments enter: trace (default) [SpinIt 2017] or angle [2014]",
      {"trace", "angle"}, [](auto& o) -> auto& { return o.form; });
}

/// Minimise SpinWeights subject to sx = sy = 0, sxz = syz = 0, and what a kind of it adds.
class Spinning : public Problem {
 public:
  [[nodiscard]] const SpinWeights& weights() const { return weights_; }
  [[nodiscard]] bool centred() const { return centred_; }  ///< sz = 0, too
  [[nodiscard]] double value(const Moments& s) const override { return weights_.value(s); }
  [[nodiscard]] Moments gradient(const Moments& s) const override { return weights_.gradient(s); }
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override { return weights_.hessian(s); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] const Nonlinear* nonlinear() const override { return nonlinear_.get(); }

  /// That Izz is 5 % larger than the moment about each of six lateral axes through a point of the axis at
  /// the centre of mass's height c. Sufficient for any s whose own height is another, as sz^2/s1 >= 2 c sz -
  /// c^2 s1, and exact at c.
  [[nodiscard]] LinearConstraints also_asked(const Moments& s) const override;

  /// Centre of mass off the axis (where it is to be the origin, off that) <= 1e-3 L, axis tilt <= 0.1
  /// degrees, Izz the largest principal moment about the centre of mass. omega_min_rpm from SpinIt's eq. 1,
  /// NaN when Izz is not the largest, the centre of mass lies below the contact point or is to be the origin:
  /// any speed will do.
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override;

 protected:
  /// @param centred  sz = 0, too: the centre of mass is the origin
  Spinning(const SpinWeights& weights, bool centred, SpinForm form);

 private:
  SpinWeights weights_;
  bool centred_;
  LinearConstraints constraints_;
  std::shared_ptr<const Nonlinear> nonlinear_;
};

/// How a solid lies to the axis, body units.
struct SpinState {
  double off_axis;      ///< of the centre of mass
  double height;        ///< of the centre of mass
  double tilt_degrees;  ///< of the principal axis nearest to z
  double about_axis;    ///< the moment about that one, through the centre of mass
  double lateral;       ///< the larger of the two others
  double moment_ratio;  ///< of the last two

  [[nodiscard]] bool largest() const { return about_axis > lateral; }
};
[[nodiscard]] SpinState spin_state(const Moments& s);

/// The least speed of a stable steady spin of a top on its tip, revolutions a minute [SpinIt, eq. 1]; NaN
/// when the moment about the principal axis nearest to z is not the largest, or the centre of mass is no
/// higher than the origin. @param length_mm  one body length in millimetres
[[nodiscard]] double omega_min_rpm(const Moments& s, double length_mm);

}  // namespace kreisel::core
