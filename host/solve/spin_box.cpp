#include "solve/spin_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace kreisel {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double eps = 0x1p-53;
constexpr MomentIndex zeros[] = {SX, SY, SXZ, SYZ};  // what spin's constraints hold at zero, in their order

Moments unit(int k) { return Moments::Unit(k); }

/// Minimise |v|^2 / Izz^2, v = (max(Lxx, 0), max(Lyy, 0), sqrt(2) sxy), where Lxx is the moment of
/// y^2 + (z - low)(z - high), Lyy that of x^2 + (z - low)(z - high): convex over positive linear. With `end`,
/// the centre of mass is at that height.
class SecantRatio final : public Problem {
 public:
  SecantRatio(double low, double high, std::optional<double> end) {
    const Moments across = unit(SZZ) - (low + high) * unit(SZ) + low * high * unit(S1);
    forms_[0] = unit(SYY) + across;
    forms_[1] = unit(SXX) + across;
    forms_[2] = std::numbers::sqrt2 * unit(SXY);
    const Eigen::Index rows = end ? 5 : 4;
    constraints_.matrix.setZero(rows, 10);
    for (int r = 0; r < 4; ++r) constraints_.matrix(r, zeros[r]) = 1;
    if (end) constraints_.matrix.row(4) = unit(SZ) - *end * unit(S1);
    constraints_.lower = constraints_.upper = Eigen::VectorXd::Zero(rows);
    constraints_.names.resize(static_cast<std::size_t>(rows));
  }

  [[nodiscard]] Eigen::Vector3d v(const Moments& s) const {
    return {std::max(forms_[0].dot(s), 0.0), std::max(forms_[1].dot(s), 0.0), forms_[2].dot(s)};
  }
  [[nodiscard]] static double izz(const Moments& s) { return s[SXX] + s[SYY]; }

  [[nodiscard]] std::string_view name() const override { return "spin in a box"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::pseudoconvex; }
  [[nodiscard]] double value(const Moments& s) const override {
    return v(s).squaredNorm() / (izz(s) * izz(s));
  }
  [[nodiscard]] Moments gradient(const Moments& s) const override {
    const double k = izz(s);
    return 2 / (k * k) * half_gradient(s) - 2 * v(s).squaredNorm() / (k * k * k) * around_;
  }
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override {
    const double k = izz(s), k2 = k * k;
    const Eigen::Vector3d w = v(s);
    const Moments half = half_gradient(s);
    Matrix10 h = Matrix10::Zero();
    for (int i = 0; i < 3; ++i)
      if (i == 2 || w[i] > 0) h += 2 / k2 * forms_[i] * forms_[i].transpose();
    return h - 4 / (k2 * k) * (half * around_.transpose() + around_ * half.transpose()) +
           6 * w.squaredNorm() / (k2 * k2) * around_ * around_.transpose();
  }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] Verdict verify(const Moments&, double) const override { return {}; }

 private:
  [[nodiscard]] Moments half_gradient(const Moments& s) const {
    const Eigen::Vector3d w = v(s);
    return w[0] * forms_[0] + w[1] * forms_[1] + w[2] * forms_[2];
  }

  Moments forms_[3];
  Moments around_ = unit(SXX) + unit(SYY);
  LinearConstraints constraints_;
};

/// The least lambda c + gamma max(t(c), 0)^2 between the ends, a convex function of c, rounded down.
double least(const SpinOptions& f, const CertifiedBox& box) {
  const auto at = [&](double c, double t) {
    t = std::max(t, 0.0);
    return f.lambda * c + f.gamma_i * t * t - 16 * eps * (f.lambda * std::abs(c) + f.gamma_i * t * t);
  };
  const double width = box.high - box.low, rise = box.t_high - box.t_low;
  double best = std::min(at(box.low, box.t_low), at(box.high, box.t_high));
  if (!(width > 0) || rise == 0) return best;
  // Stationary where 2 gamma t slope = -lambda; and where t changes its sign.
  const double slope = rise / width;
  for (const double t : {-f.lambda / (2 * f.gamma_i * slope), 0.0}) {
    const double share = (t - box.t_low) / rise;
    if (share > 0 && share < 1) best = std::min(best, at(box.low + share * width, t));
  }
  return best;
}

BoxMultipliers separating(const Eigen::VectorXd& multipliers) {
  BoxMultipliers out;
  out.mu = multipliers.head<4>();
  if (multipliers.size() == 5) {
    out.nu_high = std::max(multipliers[4], 0.0);
    out.nu_low = std::max(-multipliers[4], 0.0);
  }
  return out;
}

}  // namespace

Moments CertifiedBox::quadric(double c, double t) const {
  Moments q = u[0] * (unit(SYY) + unit(SZZ)) + u[1] * (unit(SXX) + unit(SZZ)) +
              std::numbers::sqrt2 * u[2] * unit(SXY) - t * (unit(SXX) + unit(SYY)) - nu * unit(SZ);
  q[S1] = nu * c - (u[0] + u[1]) * c * c;
  for (int r = 0; r < 4; ++r) q[zeros[r]] += mu[r];
  return q;
}

CertifiedBox certify_box(const SafeSupport& support, const SpinOptions& f, double low, double high,
                         const BoxMultipliers& m) {
  CertifiedBox box;
  box.low = low;
  box.high = high;
  box.u = m.u.cwiseMax(Eigen::Vector3d(0, 0, -infinity));
  box.u /= std::max(1.0, box.u.norm()) * (1 + 4 * eps);
  box.mu = m.mu;
  box.nu = m.nu_low - m.nu_high;
  if (box.u.isZero()) {
    // Affine in c: positive at both ends is positive between them.
    const double scale = std::max({box.mu.lpNorm<Eigen::Infinity>(), std::abs(box.nu), 1e-300});
    box.mu /= scale;
    box.nu /= scale;
    const auto fits = [&](double c) {
      if (std::isinf(c)) return c > 0 ? box.nu >= 0 : box.nu <= 0;
      const SafeSupport::Value value = support.at(box.quadric(c, 0));
      return value.h >= 2 * value.margin && value.h > 0;
    };
    box.empty = fits(low) && fits(high);
    box.value = box.empty ? infinity : -infinity;
    if (!box.empty && std::isfinite(low)) box.value = least(f, box);  // R >= 0
    return box;
  }
  box.nu += (box.u[0] + box.u[1]) * (low + high);
  const Moments around = unit(SXX) + unit(SYY);
  const auto t_low = support.largest_ratio(box.quadric(low, 0), around, m.t);
  const auto t_high = t_low ? support.largest_ratio(box.quadric(high, 0), around, m.t) : std::nullopt;
  if (t_low && t_high) {
    box.t_low = *t_low;
    box.t_high = *t_high;
  } else {  // R >= 0 is always true; u = 0 proves it
    box.u.setZero();
    box.mu.setZero();
    box.nu = 0;
  }
  box.value = least(f, box);
  return box;
}

BoxMinimum minimise_box(TotalSupport& oracle, double low, double high, const MomentPoint& near,
                        double tolerance) {
  // Bounds need multipliers that are about right, not more.
  constexpr int most_steps = 40;
  BoxMinimum out;
  out.point = near;
  std::optional<double> end;
  const auto search = [&] {
    const SecantRatio problem(low, high, end);
    const Eigen::VectorXd before = out.point.multipliers;
    out.point.multipliers.setZero(end ? 5 : 4);
    if (before.size() >= 4) out.point.multipliers.head<4>() = before.head<4>();
    out.point.active.clear();
    return find_stationary(problem, oracle, tolerance, most_steps, out.point);
  };
  const auto side = [&](double c) -> std::optional<double> {
    if (c >= low && c <= high) return std::nullopt;
    return c < low ? low : high;
  };
  const auto height = [&] { return out.point.s[SZ] / out.point.s[S1]; };
  // Is the multiplier one of c >= low, or of c <= high? Else the minimum is not at that end.
  const auto held = [&] {
    return *end == low ? out.point.multipliers[4] <= 0 : out.point.multipliers[4] >= 0;
  };
  // The ratio is pseudoconvex: if its minimum lies beyond an end, the best of the box is at that end. Most
  // often that is the end next to where the neighbour has its own.
  constexpr double close = 1e-9;
  const double from = height();
  end = from <= low + close ? std::optional(low) : from >= high - close ? std::optional(high) : std::nullopt;
  Phase phase = search();
  if (end && phase != Phase::infeasible && !held()) {
    end.reset();
    phase = search();
  }
  if (!end && phase != Phase::infeasible && side(height())) {
    end = side(height());
    phase = search();
  }
  if (phase == Phase::infeasible) {
    out.empty = true;
    out.multipliers = separating(out.point.multipliers);
    return out;
  }
  const SecantRatio problem(low, high, end);
  const Eigen::Vector3d v = problem.v(out.point.s);
  const double izz = SecantRatio::izz(out.point.s), t = v.norm() / izz;
  if (!(t > 0)) return out;
  out.multipliers = separating(izz / (2 * t) * out.point.multipliers);
  out.multipliers.u = v.normalized();
  out.multipliers.t = t;
  if (end && *end == low) out.multipliers.nu_high = 0;
  if (end && *end == high) out.multipliers.nu_low = 0;
  return out;
}

}  // namespace kreisel
