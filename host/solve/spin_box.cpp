#include "solve/spin_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace kreisel::core {
namespace {

constexpr double no_bound = std::numeric_limits<double>::infinity();
constexpr double roundoff = 0x1p-53;
constexpr MomentIndex zeros[] = {SX, SY, SXZ, SYZ};  // what the constraints hold at zero, in their order

Moments unit(int k) { return Moments::Unit(k); }

/// Minimise |v|^2 / Izz^2 + sz_weight sz^2 over a region, v = (max(Lxx, 0), max(Lyy, 0), sqrt(2) sxy), where
/// Lxx is the moment of y^2 + (z - low)(z - high), Lyy that of x^2 + (z - low)(z - high): convex over
/// positive linear, and a convex square.
class SecantRatio final : public Problem {
 public:
  SecantRatio(const SpinRegion& region, double sz_weight) : sz_weight_(sz_weight) {
    const double low = region.low, high = region.high;
    const Moments across = unit(SZZ) - (low + high) * unit(SZ) + low * high * unit(S1);
    forms_[0] = unit(SYY) + across;
    forms_[1] = unit(SXX) + across;
    forms_[2] = std::numbers::sqrt2 * unit(SXY);
    for (const MomentIndex k : zeros) add(unit(k), 0, 0);
    if (low == high) {
      add(unit(SZ) - low * unit(S1), 0, 0);
    } else {
      add(unit(SZ) - high * unit(S1), -no_bound, 0);
      add(unit(SZ) - low * unit(S1), 0, no_bound);
    }
    if (region.confines_sz()) add(unit(SZ), region.sz_low, region.sz_high);
  }

  [[nodiscard]] Eigen::Vector3d v(const Moments& s) const {
    return {std::max(forms_[0].dot(s), 0.0), std::max(forms_[1].dot(s), 0.0), forms_[2].dot(s)};
  }
  [[nodiscard]] static double izz(const Moments& s) { return s[SXX] + s[SYY]; }

  [[nodiscard]] std::string_view name() const override { return "spin in a box"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::pseudoconvex; }
  [[nodiscard]] double value(const Moments& s) const override {
    return v(s).squaredNorm() / (izz(s) * izz(s)) + sz_weight_ * s[SZ] * s[SZ];
  }
  [[nodiscard]] Moments gradient(const Moments& s) const override {
    const double k = izz(s);
    return 2 / (k * k) * half_gradient(s) - 2 * v(s).squaredNorm() / (k * k * k) * around_ +
           2 * sz_weight_ * s[SZ] * unit(SZ);
  }
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override {
    const double k = izz(s), k2 = k * k;
    const Eigen::Vector3d w = v(s);
    const Moments half = half_gradient(s);
    Matrix10 h = Matrix10::Zero();
    for (int i = 0; i < 3; ++i)
      if (i == 2 || w[i] > 0) h += 2 / k2 * forms_[i] * forms_[i].transpose();
    h(SZ, SZ) += 2 * sz_weight_;
    return h - 4 / (k2 * k) * (half * around_.transpose() + around_ * half.transpose()) +
           6 * w.squaredNorm() / (k2 * k2) * around_ * around_.transpose();
  }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] Verdict verify(const Moments&, double) const override { return {}; }

 private:
  void add(const Moments& form, double lower, double upper) {
    const Eigen::Index n = constraints_.matrix.rows();
    constraints_.matrix.conservativeResize(n + 1, 10);
    constraints_.lower.conservativeResize(n + 1);
    constraints_.upper.conservativeResize(n + 1);
    constraints_.matrix.row(n) = form;
    constraints_.lower[n] = lower;
    constraints_.upper[n] = upper;
    constraints_.names.emplace_back();
  }
  [[nodiscard]] Moments half_gradient(const Moments& s) const {
    const Eigen::Vector3d w = v(s);
    return w[0] * forms_[0] + w[1] * forms_[1] + w[2] * forms_[2];
  }

  double sz_weight_;
  Moments forms_[3];
  Moments around_ = unit(SXX) + unit(SYY);
  LinearConstraints constraints_;
};

/// The least rate w + bend w^2 + gamma max(t(w), 0)^2 between two ends, t straight between them: a convex
/// function of w, rounded down.
double least_between(double rate, double bend, double gamma, const Eigen::Vector2d& w,
                     const Eigen::Vector2d& t) {
  const auto at = [&](double x, double y) {
    y = std::max(y, 0.0);
    return rate * x + bend * x * x + gamma * y * y -
           16 * roundoff * (rate * std::abs(x) + bend * x * x + gamma * y * y);
  };
  const double width = w[1] - w[0], slope = (t[1] - t[0]) / width;
  double best = std::min(at(w[0], t[0]), at(w[1], t[1]));
  if (!(width > 0)) return best;
  const auto try_at = [&](double x) {
    if (x > w[0] && x < w[1]) best = std::min(best, at(x, t[0] + slope * (x - w[0])));
  };
  // Stationary with t > 0 or without; and where t changes its sign.
  const double curved = bend + gamma * slope * slope;
  if (curved > 0) try_at(-(rate / 2 + gamma * slope * (t[0] - slope * w[0])) / curved);
  if (bend > 0) try_at(-rate / (2 * bend));
  if (slope != 0) try_at(w[0] - t[0] / slope);
  return best;
}

/// The least value of f that the box allows. Over first moments t is straight along either end of the height,
/// and no less between the two.
double least(const SpinWeights& f, const CertifiedBox& box) {
  const Eigen::Vector2d heights(box.low, box.high), first(box.sz_low, box.sz_high);
  if (!box.region().confines_sz())
    return least_between(f.lambda, f.height, f.gamma_i, heights, {box.t_low, box.t_high});
  return least_between(f.lambda, f.height, 0, heights, {0, 0}) +
         std::min(least_between(0, f.moment, f.gamma_i, first, {box.t_low, box.t_low_above}),
                  least_between(0, f.moment, f.gamma_i, first, {box.t_high, box.t_high_above}));
}

/// Which rows of a region's problem hold at the point that a search starts from; equalities always.
std::vector<bool> active_near(const Rows& rows, const Moments& s) {
  constexpr double close = 1e-9;
  std::vector<bool> active;
  for (Eigen::Index i = 0; i < rows.size(); ++i)
    active.push_back(rows.equality[static_cast<std::size_t>(i)] ||
                     rows.matrix.row(i).dot(s) >= rows.bound[i] - close);
  return active;
}

/// The multipliers of a region's rows, by what they belong to.
BoxMultipliers sorted(const Eigen::VectorXd& multipliers, const SpinRegion& region) {
  BoxMultipliers out;
  out.mu = multipliers.head<4>();
  Eigen::Index next = 4;
  if (region.low == region.high) {
    out.nu_high = multipliers[next++];
  } else {
    out.nu_high = multipliers[next++];
    out.nu_low = multipliers[next++];
  }
  if (region.sz_low == region.sz_high)
    out.kappa = -multipliers[next];
  else if (region.confines_sz())
    out.kappa = multipliers[next + 1] - multipliers[next];
  return out;
}

}  // namespace

Moments CertifiedBox::quadric(double c, double t) const {
  Moments q = u[0] * (unit(SYY) + unit(SZZ)) + u[1] * (unit(SXX) + unit(SZZ)) +
              std::numbers::sqrt2 * u[2] * unit(SXY) - t * (unit(SXX) + unit(SYY)) - (nu + kappa) * unit(SZ);
  q[S1] = nu * c - (u[0] + u[1]) * c * c;
  for (int r = 0; r < 4; ++r) q[zeros[r]] += mu[r];
  return q;
}

CertifiedBox certify_box(const SafeSupport& support, const SpinWeights& f, const SpinRegion& region,
                         const BoxMultipliers& m) {
  CertifiedBox box;
  box.low = region.low;
  box.high = region.high;
  box.sz_low = region.sz_low;
  box.sz_high = region.sz_high;
  box.u = m.u.cwiseMax(Eigen::Vector3d(0, 0, -no_bound));
  box.u /= std::max(1.0, box.u.norm()) * (1 + 4 * roundoff);
  box.mu = m.mu;
  box.nu = m.nu_low - m.nu_high;
  box.kappa = region.confines_sz() ? m.kappa : 0;
  // Of first moments that are not confined, nothing depends on the end.
  const auto offset = [&](double sz) { return region.confines_sz() ? box.kappa * sz : 0.0; };
  if (box.u.isZero()) {
    // Affine in c and sz: positive at all corners is positive between them.
    const double scale =
        std::max({box.mu.lpNorm<Eigen::Infinity>(), std::abs(box.nu), std::abs(box.kappa), 1e-300});
    box.mu /= scale;
    box.nu /= scale;
    box.kappa /= scale;
    const auto fits = [&](double c, double sz) {
      if (std::isinf(c)) return c > 0 ? box.nu >= 0 : box.nu <= 0;
      const SafeSupport::Value value = support.at(box.quadric(c, 0), offset(sz));
      return value.h >= 2 * value.margin && value.h > 0;
    };
    box.empty = true;
    for (const double sz : {box.sz_low, box.sz_high}) {
      box.empty = box.empty && fits(box.low, sz) && fits(box.high, sz);
      if (!region.confines_sz()) break;
    }
    box.value = box.empty ? no_bound : -no_bound;
    if (!box.empty && std::isfinite(box.low)) box.value = least(f, box);  // R >= 0
    return box;
  }
  box.nu += (box.u[0] + box.u[1]) * (box.low + box.high);
  const Moments around = unit(SXX) + unit(SYY);
  bool fine = true;
  const auto largest = [&](double c, double sz) {
    const auto t = fine ? support.largest_ratio(box.quadric(c, 0), around, m.t, offset(sz)) : std::nullopt;
    fine = t.has_value();
    return t.value_or(0);
  };
  box.t_low = largest(box.low, box.sz_low);
  box.t_high = largest(box.high, box.sz_low);
  if (region.confines_sz()) {
    box.t_low_above = largest(box.low, box.sz_high);
    box.t_high_above = largest(box.high, box.sz_high);
  }
  if (!fine) {  // R >= 0 is always true; u = 0 proves it
    box.t_low = box.t_high = box.t_low_above = box.t_high_above = 0;
    box.u.setZero();
    box.mu.setZero();
    box.nu = box.kappa = 0;
  }
  box.value = least(f, box);
  return box;
}

BoxMinimum minimise_box(TotalSupport& oracle, const SpinWeights& f, const SpinRegion& region,
                        const MomentPoint& near, double tolerance) {
  // Bounds need multipliers that are about right, not more.
  constexpr int most_steps = 40;
  const double sz_weight = region.confines_sz() ? f.moment / f.gamma_i : 0;
  const SecantRatio problem(region, sz_weight);
  const Rows rows = rows_of(problem.constraints(), false);
  BoxMinimum out;
  out.point = near;
  const Eigen::VectorXd before = out.point.multipliers;
  out.point.multipliers.setZero(rows.size());
  if (before.size() >= 4) out.point.multipliers.head<4>() = before.head<4>();
  out.point.active = active_near(rows, near.s);
  if (find_stationary(problem, oracle, tolerance, most_steps, out.point) == Phase::infeasible) {
    out.empty = true;
    out.multipliers = sorted(out.point.multipliers, region);
    return out;
  }
  const Eigen::Vector3d v = problem.v(out.point.s);
  const double izz = SecantRatio::izz(out.point.s), t = v.norm() / izz;
  if (!(t > 0)) return out;
  // With (Izz / 2t) times the gradient, what is left of |v|^2 / Izz^2 is u . (Lxx, Lyy, sqrt(2) sxy) - t Izz.
  out.multipliers = sorted(izz / (2 * t) * out.point.multipliers, region);
  out.multipliers.u = v.normalized();
  out.multipliers.t = t;
  out.multipliers.kappa -= izz / t * sz_weight * out.point.s[SZ];
  return out;
}

}  // namespace kreisel::core
