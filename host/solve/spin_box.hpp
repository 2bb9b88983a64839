// spin_box.hpp - the spinning problem with the height of the centre of mass confined. [docs/quadric.md, s. 4]
#pragma once

#include <optional>

#include "problem/spin.hpp"
#include "solve/moment.hpp"
#include "solve/safe_support.hpp"

namespace kreisel {

/// What proves a lower bound on f over all fillings whose centre of mass is between two heights. At a height
/// c of the box the proof's quadric is
///
///   u1 (y^2 + z^2 - c^2) + u2 (x^2 + z^2 - c^2) + sqrt(2) u3 xy - t(c) (x^2 + y^2) + mu . (x, y, xz, yz)
///   + nu (c - z),
///
/// t straight between the ends, |u| <= 1, u1 and u2 >= 0; its support is >= 0 at both ends, so the root R of
/// f's inertia ratio is >= t(c). Half-infinite boxes have u = 0, and their only end proves them empty.
struct CertifiedBox {
  double low = 0, high = 0;  ///< heights of the centre of mass, body units
  bool empty = false;        ///< no filling meets the constraints here
  double value = 0;          ///< f >= value in the box; infinite where empty
  double t_low = 0, t_high = 0;
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  Eigen::Vector4d mu = Eigen::Vector4d::Zero();
  double nu = 0;

  /// The proof's quadric at height c, with this t.
  [[nodiscard]] Moments quadric(double c, double t) const;
};

/// Multipliers of the secant's problem in a box, as a search leaves them: nu_low, nu_high >= 0 of its ends.
struct BoxMultipliers {
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  Eigen::Vector4d mu = Eigen::Vector4d::Zero();
  double nu_low = 0, nu_high = 0, t = 0;
};

/// The bound that these multipliers prove, found by passes over the rays alone. A poor choice makes a poor
/// bound, never a wrong one.
[[nodiscard]] CertifiedBox certify_box(const SafeSupport& support, const SpinOptions& f, double low,
                                       double high, const BoxMultipliers& multipliers);

struct BoxMinimum {
  MomentPoint point;  ///< of the box's problem
  BoxMultipliers multipliers;
  bool empty = false;  ///< by the multipliers, u = 0
};

/// Minimises the secant's bound on the inertia ratio over a box, from `near` on.
/// @param tolerance  on the residual, no less than the oracle's arithmetic allows
[[nodiscard]] BoxMinimum minimise_box(TotalSupport& oracle, double low, double high, const MomentPoint& near,
                                      double tolerance = 1e-12);

}  // namespace kreisel
