#include "problem/spinning.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

#include "physics/units.hpp"
#include "problem/principal_angle.hpp"
#include "problem/spin_terms.hpp"
#include "problem/stable_speeds.hpp"

namespace kreisel::core {
namespace {

SquareRatio<10> inertia_ratio(const Moments& s) {
  const Shift shift(s);
  const double a = s[SYY] + s[SZZ] - shift.value, b = s[SXX] + s[SZZ] - shift.value, c = s[SXY];
  const Moments ga = unit_moment(SYY) + unit_moment(SZZ) - shift.gradient,
                gb = unit_moment(SXX) + unit_moment(SZZ) - shift.gradient, gc = unit_moment(SXY);
  SquareRatio<10> r;
  r.squares = a * a + b * b + 2 * c * c;
  r.half_gradient = a * ga + b * gb + 2 * c * gc;
  r.half_hessian =
      ga * ga.transpose() + gb * gb.transpose() + 2 * gc * gc.transpose() - (a + b) * shift.hessian;
  r.below = s[SXX] + s[SYY];
  r.gradient_below = unit_moment(SXX) + unit_moment(SYY);
  return r;
}

}  // namespace

double SpinWeights::value(const Moments& s) const {
  return height_value(*this, s) + gamma_i * inertia_ratio(s).value();
}

Moments SpinWeights::gradient(const Moments& s) const {
  return height_gradient(*this, s) + gamma_i * inertia_ratio(s).gradient();
}

Matrix10 SpinWeights::hessian(const Moments& s) const {
  return height_hessian(*this, s) + gamma_i * inertia_ratio(s).hessian();
}

Spinning::Spinning(const SpinWeights& weights, bool centred, SpinForm form)
    : weights_(weights), centred_(centred) {
  std::vector<MomentIndex> zero = {SX, SY, SXZ, SYZ};
  if (centred) zero.push_back(SZ);
  const auto rows = static_cast<Eigen::Index>(zero.size());
  constraints_.matrix.setZero(rows, 10);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const MomentIndex k = zero[static_cast<std::size_t>(row)];
    constraints_.matrix(row, k) = 1;
    constraints_.names.emplace_back(k == SX || k == SY ? "the centre of mass stays {} beside the axis"
                                    : k == SZ
                                        ? "the centre of mass stays {} above or below the axle's centre"
                                        : "a product of inertia of {} stays, which tilts the principal axis");
  }
  constraints_.lower = constraints_.upper = Eigen::VectorXd::Zero(rows);
  if (form == SpinForm::angle) nonlinear_ = std::make_shared<PrincipalAngle>(weights);
}

LinearConstraints Spinning::also_asked(const Moments& s) const {
  constexpr int directions = 6;  // a half turn of them: 30 degrees apart, none misses a moment by over 2 %
  constexpr double larger = 1.05;
  const double c = s[SZ] / s[S1];
  LinearConstraints rows;
  rows.matrix.setZero(directions, 10);
  rows.lower.setZero(directions);
  rows.upper.setConstant(directions, std::numeric_limits<double>::infinity());
  for (int k = 0; k < directions; ++k) {
    const double angle = k * std::numbers::pi / directions, x = std::cos(angle), y = std::sin(angle);
    auto row = rows.matrix.row(k);
    // Across the axis (x, y, 0): z - c and y px - x py.
    row[SZZ] = 1;
    row[SZ] = -2 * c;
    row[S1] = c * c;
    row[SXX] = y * y;
    row[SYY] = x * x;
    row[SXY] = -2 * x * y;
    row *= -larger;
    row[SXX] += 1;
    row[SYY] += 1;
    rows.names.push_back(
        fmt::format("the moment about the axis stays {{}} short of 1.05 times that about the line across it "
                    "at {:.0f} degrees",
                    30.0 * k));
  }
  return rows;
}

SpinState spin_state(const Moments& s) {
  const Eigen::Vector3d c = centre_of_mass(s);
  const PrincipalAxes principal(inertia_about_centre(s));
  const int spin = principal.nearest_to_z();
  const double about_axis = principal.moments[spin], lateral = principal.moments[spin == 2 ? 1 : 2];
  return {std::hypot(c[0], c[1]), c[2], principal.tilt_degrees(), about_axis, lateral, about_axis / lateral};
}

double omega_min_rpm(const Moments& s, double length_mm) {
  const SpinState state = spin_state(s);
  if (!(state.largest() && state.height > 0)) return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(s[S1] * state.height / (state.about_axis - state.lateral)) * rpm_per_unit(length_mm);
}

Verdict Spinning::verify(const Moments& s, double length_mm) const {
  const SpinState state = spin_state(s);
  const double off_axis = state.off_axis, off = centred_ ? centre_of_mass(s).norm() : off_axis,
               tilt = state.tilt_degrees, ratio = state.moment_ratio,
               omega_min = centred_ ? std::numeric_limits<double>::quiet_NaN() : omega_min_rpm(s, length_mm);
  const std::string_view place = centred_ ? "the axle's centre" : "the axis";
  const bool central = off <= 1e-3, upright = tilt <= 0.1, largest = state.largest();

  Verdict verdict;
  verdict.ok = central && upright && largest;
  verdict.values = {{"off_axis", off_axis},       {"off_axis_mm", off_axis * length_mm},
                    {"tilt_degrees", tilt},       {"largest_over_lateral", ratio},
                    {"omega_min_rpm", omega_min}, {"centre_of_mass_z_mm", state.height * length_mm},
                    {"objective", value(s)}};
  const std::string where = fmt::format(
      "centre of mass {:.3f} mm off {} ({:.1e} L), axis tilted {:.3f} degrees, "
      "Izz {:.3f} times the next moment",
      off * length_mm, place, off, tilt, ratio);
  if (verdict.ok) {
    verdict.text = "spins: " + where;
    if (std::isfinite(omega_min)) verdict.text += fmt::format("; stable above {:.0f} rpm", omega_min);
  } else {
    std::vector<std::string> reasons;
    if (!central) reasons.push_back(fmt::format("centre of mass off {} by more than 1e-3 L", place));
    if (!upright) reasons.emplace_back("axis not principal within 0.1 degrees");
    if (!largest) reasons.emplace_back("Izz is not the largest principal moment");
    verdict.text = fmt::format("does not spin ({}): {}", fmt::join(reasons, "; "), where);
  }
  if (!centred_) add_stable_speeds(verdict, s, length_mm);
  return verdict;
}

}  // namespace kreisel::core
