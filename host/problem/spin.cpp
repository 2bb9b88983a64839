#include "problem/spin.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

#include "error.hpp"
#include "parse.hpp"
#include "problem/stable_speeds.hpp"

namespace kreisel {
namespace {

/// The four scalars that the objective is made of, as linear forms of s and of q = sz^2 / s1.
struct Parts {
  double q, a, b, c, k;  ///< a = Jxx, b = Jyy, c = Ixy up to its sign, k = Izz
};

Parts parts_of(const Moments& s) {
  const double q = s[SZ] * s[SZ] / s[S1];
  return {q, s[SYY] + s[SZZ] - q, s[SXX] + s[SZZ] - q, s[SXY], s[SXX] + s[SYY]};
}

/// Gradient of q = sz^2 / s1.
Moments gradient_q(const Moments& s) {
  const double z = s[SZ] / s[S1];
  Moments g = Moments::Zero();
  g[S1] = -z * z;
  g[SZ] = 2 * z;
  return g;
}

struct PartGradients {
  Moments a, b, c, k;
};

PartGradients part_gradients(const Moments& s) {
  PartGradients g;
  const Moments q = gradient_q(s);
  const auto unit = [](int i) { return Moments(Moments::Unit(i)); };
  g.a = unit(SYY) + unit(SZZ) - q;
  g.b = unit(SXX) + unit(SZZ) - q;
  g.c = unit(SXY);
  g.k = unit(SXX) + unit(SYY);
  return g;
}

}  // namespace

Spin::Spin(const SpinOptions& options) : options_(options) {
  constraints_.matrix.setZero(4, 10);
  const MomentIndex zero[] = {SX, SY, SXZ, SYZ};
  for (int row = 0; row < 4; ++row) {
    constraints_.matrix(row, zero[row]) = 1;
    constraints_.names.emplace_back(fmt::format("{} = 0", moment_names[zero[row]]));
  }
  constraints_.lower = constraints_.upper = Eigen::VectorXd::Zero(4);
}

double Spin::value(const Moments& s) const {
  const Parts p = parts_of(s);
  return options_.lambda * s[SZ] / s[S1] +
         options_.gamma_i * (p.a * p.a + p.b * p.b + 2 * p.c * p.c) / (p.k * p.k);
}

Moments Spin::gradient(const Moments& s) const {
  const Parts p = parts_of(s);
  const PartGradients g = part_gradients(s);
  const double n = p.a * p.a + p.b * p.b + 2 * p.c * p.c, kk = p.k * p.k;
  Moments f = 2 * options_.gamma_i * ((p.a * g.a + p.b * g.b + 2 * p.c * g.c) / kk - n / (kk * p.k) * g.k);
  f[SZ] += options_.lambda / s[S1];
  f[S1] -= options_.lambda * s[SZ] / (s[S1] * s[S1]);
  return f;
}

Matrix10 Spin::hessian(const Moments& s) const {
  const Parts p = parts_of(s);
  const PartGradients g = part_gradients(s);
  const double n = p.a * p.a + p.b * p.b + 2 * p.c * p.c, k2 = p.k * p.k, k3 = k2 * p.k;
  const double m = s[S1], z = s[SZ] / m;

  Matrix10 hess_q = Matrix10::Zero();  // of sz^2 / s1
  hess_q(S1, S1) = 2 * z * z / m;
  hess_q(SZ, SZ) = 2 / m;
  hess_q(S1, SZ) = hess_q(SZ, S1) = -2 * z / m;

  const Moments half_n = p.a * g.a + p.b * g.b + 2 * p.c * g.c;  // half the gradient of n
  Matrix10 h =
      g.a * g.a.transpose() + g.b * g.b.transpose() + 2 * g.c * g.c.transpose() - (p.a + p.b) * hess_q;
  h = 2 / k2 * h - 4 / k3 * (half_n * g.k.transpose() + g.k * half_n.transpose()) +
      6 * n / (k3 * p.k) * g.k * g.k.transpose();
  h *= options_.gamma_i;

  h(SZ, S1) -= options_.lambda / (m * m);
  h(S1, SZ) -= options_.lambda / (m * m);
  h(S1, S1) += 2 * options_.lambda * z / (m * m);
  return h;
}

Verdict Spin::verify(const Moments& s, double length_mm) const {
  const Eigen::Vector3d c = centre_of_mass(s);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(inertia_about_centre(s));
  // The principal axis nearest to z; the two others are the lateral ones.
  int spin = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(principal.eigenvectors()(2, i)) > std::abs(principal.eigenvectors()(2, spin))) spin = i;
  const double off_axis = std::hypot(c[0], c[1]);
  const double sine = principal.eigenvectors().col(spin).head<2>().norm();
  const double tilt = std::asin(std::min(1.0, sine)) * 180 / std::numbers::pi;
  const double izz = principal.eigenvalues()[spin];
  const double lateral = principal.eigenvalues()[spin == 2 ? 1 : 2];
  const bool largest = izz > lateral;

  double omega_min = std::numeric_limits<double>::quiet_NaN();
  if (largest && c[2] > 0) {
    constexpr double gravity = 9.80665;  // m/s^2
    const double length = length_mm * 1e-3;
    omega_min = std::sqrt(s[S1] * gravity * c[2] / ((izz - lateral) * length)) * 30 / std::numbers::pi;
  }

  Verdict verdict;
  verdict.values = {{"off_axis", off_axis},       {"off_axis_mm", off_axis * length_mm},
                    {"tilt_degrees", tilt},       {"largest_over_lateral", izz / lateral},
                    {"omega_min_rpm", omega_min}, {"centre_of_mass_z_mm", c[2] * length_mm},
                    {"objective", value(s)}};
  const bool centred = off_axis <= 1e-3, upright = tilt <= 0.1;
  verdict.ok = centred && upright && largest;
  const std::string where = fmt::format(
      "centre of mass {:.3f} mm off the axis ({:.1e} L), axis tilted {:.3f} degrees, "
      "Izz {:.3f} times the next moment",
      off_axis * length_mm, off_axis, tilt, izz / lateral);
  if (verdict.ok) {
    verdict.text = "spins: " + where;
    if (std::isfinite(omega_min)) verdict.text += fmt::format("; stable above {:.0f} rpm", omega_min);
  } else {
    std::vector<std::string_view> reasons;
    if (!centred) reasons.push_back("centre of mass off the axis by more than 1e-3 L");
    if (!upright) reasons.push_back("axis not principal within 0.1 degrees");
    if (!largest) reasons.push_back("Izz is not the largest principal moment");
    verdict.text = fmt::format("does not spin ({}): {}", fmt::join(reasons, "; "), where);
  }
  add_stable_speeds(verdict, s, length_mm);
  return verdict;
}

std::unique_ptr<Problem> make_spin(const ProblemSettings& settings, const Body&) {
  SpinOptions options;
  for (const auto& [name, text] : settings) {
    const double value = parse<double>(text).value_or(-1);
    if (name == "lambda" && value >= 0)
      options.lambda = value;
    else if (name == "gamma_i" && value > 0)
      options.gamma_i = value;
    else
      throw InputError(
          fmt::format("problem.{} = {} for spin; expected lambda >= 0 or gamma_i > 0", name, text));
  }
  return std::make_unique<Spin>(options);
}

}  // namespace kreisel
