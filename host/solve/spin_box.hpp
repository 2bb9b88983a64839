// spin_box.hpp - a spinning problem with the height of the centre of mass confined. [docs/quadric.md, s. 4]
#pragma once

#include <limits>
#include <optional>

#include "problem/spinning.hpp"
#include "solve/moment.hpp"
#include "solve/safe_support.hpp"

namespace kreisel::core {

/// Heights of the centre of mass, and where f weighs sz^2 also first moments sz; body units.
struct SpinRegion {
  double low = 0, high = 0;
  double sz_low = -std::numeric_limits<double>::infinity(), sz_high = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool confines_sz() const { return sz_low > -std::numeric_limits<double>::infinity(); }
};

/// What proves a lower bound on f over all fillings of a region. At a height c of it and a first moment m the
/// proof's quadric is
///
///   u1 (y^2 + z^2 - c^2) + u2 (x^2 + z^2 - c^2) + sqrt(2) u3 xy - t(c, m) (x^2 + y^2) + mu . (x, y, xz, yz)
///   + nu (c - z) - kappa z,
///
/// |u| <= 1, u1 and u2 >= 0. Its support plus kappa m is >= 0 at all corners, so the root R of f's inertia
/// ratio is >= t(c, m), a concave function, there and hence on the lines between them. Without ends of sz,
/// kappa = 0, and there are two corners. Half-infinite boxes have u = 0, and their only end proves them
/// empty.
struct CertifiedBox {
  double low = 0, high = 0;  ///< heights of the centre of mass, body units
  bool empty = false;        ///< no filling meets the constraints here
  double value = 0;          ///< f >= value in the box; infinite where empty
  double t_low = 0, t_high = 0;
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  Eigen::Vector4d mu = Eigen::Vector4d::Zero();
  double nu = 0;
  double sz_low = SpinRegion{}.sz_low, sz_high = SpinRegion{}.sz_high;  ///< first moments, M L
  double t_low_above = 0, t_high_above = 0;  ///< t at sz_high; t_low and t_high are at sz_low
  double kappa = 0;

  [[nodiscard]] SpinRegion region() const { return {low, high, sz_low, sz_high}; }
  /// The proof's quadric at height c, with this t.
  [[nodiscard]] Moments quadric(double c, double t) const;
};

/// Multipliers of the secant's problem in a region, as a search leaves them: nu_low, nu_high >= 0 of its ends
/// of the height, kappa of sz.
struct BoxMultipliers {
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  Eigen::Vector4d mu = Eigen::Vector4d::Zero();
  double nu_low = 0, nu_high = 0, t = 0, kappa = 0;
};

/// The bound that these multipliers prove, found by passes over the rays alone. A poor choice makes a poor
/// bound, never a wrong one.
[[nodiscard]] CertifiedBox certify_box(const SafeSupport& support, const SpinWeights& f,
                                       const SpinRegion& region, const BoxMultipliers& multipliers);

struct BoxMinimum {
  MomentPoint point;  ///< of the region's problem
  BoxMultipliers multipliers;
  bool empty = false;  ///< by the multipliers, u = 0
};

/// Minimises the secant's bound on the inertia ratio, and what f weighs of sz^2 beside it, over a region,
/// from `near` on.
/// @param tolerance  on the residual, no less than the oracle's arithmetic allows
[[nodiscard]] BoxMinimum minimise_box(TotalSupport& oracle, const SpinWeights& f, const SpinRegion& region,
                                      const MomentPoint& near, double tolerance = 1e-12);

}  // namespace kreisel::core
