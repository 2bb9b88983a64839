#include "solve/dual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solve/dense.hpp"

namespace kreisel::core {

Support TotalSupport::operator()(const Moments& q, bool with_hessian) {
  ++(with_hessian ? hessian_passes_ : passes_);
  Support support = oracle_->support(level_, q, with_hessian);
  support.moments = mass_->total(support.moments);
  support.value = q.dot(support.moments);
  support.hessian *= mass_->contrast;
  return support;
}

double Rows::violation(const Moments& s) const {
  double worst = 0;
  const Eigen::VectorXd excess = matrix * s - bound;
  for (Eigen::Index i = 0; i < size(); ++i)
    worst = std::max(worst, equality[static_cast<std::size_t>(i)] ? std::abs(excess[i]) : excess[i]);
  return worst;
}

Rows rows_of(const LinearConstraints& c, bool split) {
  std::vector<Eigen::Index> from;
  std::vector<double> sign, bound;
  Rows rows;
  const auto add = [&](Eigen::Index r, double side, double value, bool equality) {
    from.push_back(r);
    sign.push_back(side);
    bound.push_back(side * value);
    rows.equality.push_back(equality);
  };
  for (Eigen::Index r = 0; r < c.matrix.rows(); ++r) {
    if (c.lower[r] == c.upper[r] && !split) {
      add(r, 1, c.upper[r], true);
      continue;
    }
    if (std::isfinite(c.upper[r])) add(r, 1, c.upper[r], false);
    if (std::isfinite(c.lower[r])) add(r, -1, c.lower[r], false);
  }
  const auto n = static_cast<Eigen::Index>(from.size());
  rows.matrix.resize(n, 10);
  rows.bound = Eigen::Map<Eigen::VectorXd>(bound.data(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    rows.matrix.row(i) = sign[at] * c.matrix.row(from[at]);
  }
  return rows;
}

namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// The dual as a function of v = (p, multipliers).
class Dual {
 public:
  Dual(TotalSupport& oracle, const QuadraticModel& model, const Rows& rows)
      : oracle_(oracle),
        model_(model),
        forms_(10, model.factor.cols() + rows.size()),
        offsets_(forms_.cols()) {
    forms_ << model.factor, rows.matrix.transpose();
    offsets_ << model.target, rows.bound;
  }

  [[nodiscard]] bool stopped() const { return oracle_.stopped(); }

  [[nodiscard]] Eigen::Index squares() const { return model_.factor.cols(); }
  [[nodiscard]] Eigen::Index size() const { return forms_.cols(); }

  struct Value {
    Moments q;
    Support support;
    double dual = 0;
    Vector gradient;  ///< of the dual in v
  };

  [[nodiscard]] Value at(const Vector& v) {
    Value value;
    value.q = model_.linear + forms_ * v;
    value.support = oracle_(value.q, true);
    const auto p = v.head(squares());
    value.dual = value.support.value - offsets_.dot(v) - p.squaredNorm() / 2;
    value.gradient = forms_.transpose() * value.support.moments - offsets_;
    value.gradient.head(squares()) -= p;
    return value;
  }
  /// Do these multipliers separate the rows from the attainable moments? Then
  /// no filling meets them.
  [[nodiscard]] bool separates(const Vector& v) {
    const Vector rest = v.tail(size() - squares());
    const double norm = rest.lpNorm<Eigen::Infinity>();
    const Moments q = forms_.rightCols(rest.size()) * (rest / norm);
    // Round-off of a sum of terms of order one is far below this.
    constexpr double certain = 1e-10;
    return oracle_(q, false).value - offsets_.tail(rest.size()).dot(rest / norm) > certain;
  }
  [[nodiscard]] Matrix hessian(const Value& value) const {
    Matrix h = forms_.transpose() * value.support.hessian * forms_;
    h.topLeftCorner(squares(), squares()) -= Matrix::Identity(squares(), squares());
    return h;
  }

 private:
  TotalSupport& oracle_;
  const QuadraticModel& model_;
  Matrix forms_;
  Vector offsets_;
};

struct Newton {
  Vector v;
  Dual::Value value;
  double residual = 0;
  double slack = 0;  ///< t of a margin
  enum { converged, stalled, separated, interrupted } ending = stalled;
};

constexpr int most_steps = 150;

/// Maximises the dual over multipliers >= 0 of inequalities, any of equalities,
/// and, for a margin, of sum one, by Newton's method in those that are not held
/// at zero. [Bertsekas 1982, Projected Newton methods]
class Maximiser {
 public:
  Maximiser(Dual& dual, const Rows& rows, bool margin, double tolerance)
      : dual_(dual), margin_(margin), tolerance_(tolerance), bounded_(static_cast<std::size_t>(dual.size())) {
    for (Eigen::Index i = 0; i < rows.size(); ++i)
      bounded_[static_cast<std::size_t>(dual.squares() + i)] = !rows.equality[static_cast<std::size_t>(i)];
  }

  /// @param patience  steps that may go by without the residual falling by a third, or the multipliers
  ///                  growing fourfold
  Newton run(Vector v, int patience);

 private:
  [[nodiscard]] bool bounded(Eigen::Index i) const { return bounded_[static_cast<std::size_t>(i)]; }
  /// The Newton step in the components that are not held; `held` grows by those
  /// that it would drive below 0.
  Vector step(const Newton& at, std::vector<bool>& held);
  /// How far to go along d, at most `most`; moves `at`.
  void search(Newton& at, const Vector& d, double most);

  Dual& dual_;
  bool margin_;
  double tolerance_;
  std::vector<bool> bounded_;
};

Vector Maximiser::step(const Newton& at, std::vector<bool>& held) {
  const Matrix hessian = dual_.hessian(at.value);
  // Directions in which no ray ends are flat: damping keeps the step within
  // reach, for what is known of the dual does not go far.
  const double reach = 4 * std::max(1.0, at.v.lpNorm<Eigen::Infinity>());
  double damping = std::max(dual_.size() ? 1e-14 * -hessian.diagonal().minCoeff() : 0.0, 1e-14);
  for (;;) {
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < dual_.size(); ++i)
      if (!held[static_cast<std::size_t>(i)]) free.push_back(i);
    const auto n = static_cast<Eigen::Index>(free.size());
    // A margin's multipliers keep their sum: one more row and column.
    const Eigen::Index more = margin_ ? 1 : 0;
    Matrix system = Matrix::Zero(n + more, n + more);
    system.topLeftCorner(n, n) = -hessian(free, free);
    system.diagonal().head(n).array() += damping;
    for (Eigen::Index i = 0; i < n; ++i)
      if (more && free[static_cast<std::size_t>(i)] >= dual_.squares()) system(i, n) = system(n, i) = 1;
    Vector right = Vector::Zero(n + more);
    right.head(n) = at.value.gradient(free);
    const Vector solution = more ? elimination(system, right) : semidefinite_solution(system, right);
    Vector d = Vector::Zero(dual_.size());
    d(free) = solution.head(n);
    bool again = false;
    for (Eigen::Index i = 0; i < dual_.size(); ++i)
      if (bounded(i) && at.v[i] == 0 && d[i] < 0) held[static_cast<std::size_t>(i)] = again = true;
    if (again) continue;
    if (!(d.lpNorm<Eigen::Infinity>() > reach)) return d;
    damping *= 100;
  }
}

void Maximiser::search(Newton& at, const Vector& d, double most) {
  // The dual is concave: a step after which it still rises has gained; one
  // after which it falls, less steeply than it rose before, is good enough
  // unless there was a kink between, which the values show. Near the end slopes
  // keep their digits where values have lost them.
  const double rise = at.value.gradient.dot(d);
  const double least = at.value.dual - 1e-14 * (1 + std::abs(at.value.dual));
  double alpha = most;
  constexpr int most_trials = 30;
  for (int trial = 1;; ++trial) {
    Vector v = at.v + alpha * d;
    for (Eigen::Index i = 0; i < v.size(); ++i)
      if (bounded(i) && v[i] < 1e-14 * std::abs(at.v[i])) v[i] = 0;
    Dual::Value value = dual_.at(v);
    const double slope = value.gradient.dot(d);
    const bool gained = slope >= 0 || (slope >= -0.5 * rise && value.dual >= least);
    if (gained || trial == most_trials) {
      at.v = std::move(v);
      at.value = std::move(value);
      return;
    }
    const double secant = alpha * rise / (rise - slope);
    alpha = std::clamp(secant, 0.05 * alpha, 0.7 * alpha);
  }
}

Newton Maximiser::run(Vector v, int patience) {
  const Eigen::Index n = dual_.size(), squares = dual_.squares();
  Newton at;
  at.v = std::move(v);
  at.value = dual_.at(at.v);
  double best = std::numeric_limits<double>::infinity();
  double checked = 10;  // size of the multipliers when they were last asked
                        // whether they separate
  int without_progress = 0;
  for (int count = 0;; ++count) {
    const Vector& g = at.value.gradient;
    at.slack = margin_ ? at.v.tail(n - squares).dot(g.tail(n - squares)) : 0;
    std::vector<bool> held(static_cast<std::size_t>(n));
    at.residual = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double rest = g[i] - (i >= squares ? at.slack : 0);
      const bool hold = bounded(i) && at.v[i] == 0 && rest <= 0;
      held[static_cast<std::size_t>(i)] = hold;
      if (!hold) at.residual = std::max(at.residual, std::abs(rest));
    }
    if (at.residual <= tolerance_) {
      at.ending = Newton::converged;
      return at;
    }
    if (dual_.stopped()) {
      at.ending = Newton::interrupted;
      return at;
    }
    without_progress = at.residual < 0.7 * best ? 0 : without_progress + 1;
    best = std::min(best, at.residual);
    const bool round_off = without_progress >= 4 && best < 1e3 * tolerance_;
    const bool at_kink = margin_ && at.value.q.cwiseAbs().maxCoeff() < 1e-12;
    if (round_off || at_kink || without_progress > patience || count == most_steps) return at;

    const Vector d = step(at, held);
    if (!d.allFinite() || d.isZero(0)) return at;
    double most = 1;  // no multiplier below zero
    for (Eigen::Index i = squares; i < n; ++i)
      if (bounded(i) && d[i] < 0) most = std::min(most, -at.v[i] / d[i]);
    search(at, d, most);
    if (const double size = n > squares ? at.v.tail(n - squares).lpNorm<Eigen::Infinity>() : 0;
        !margin_ && size > 4 * checked) {
      checked = size;
      without_progress = 0;
      if (dual_.separates(at.v)) {
        at.ending = Newton::separated;
        return at;
      }
    }
  }
}

/// minimise_model() with all rows at once.
DualPoint minimise_with(TotalSupport& oracle, const QuadraticModel& model, const Rows& rows,
                        const Vector& start, double tolerance, int patience = most_steps) {
  const Eigen::Index m = rows.size(), squares = model.factor.cols();
  Vector v = Vector::Zero(squares + m);
  if (start.size() == m) v.tail(m) = start;
  for (Eigen::Index i = 0; i < m; ++i)
    if (!rows.equality[static_cast<std::size_t>(i)]) v[squares + i] = std::max(v[squares + i], 0.0);
  if (model.margin) {
    const double sum = v.tail(m).sum();
    if (sum > 0)
      v.tail(m) /= sum;
    else
      v.tail(m).setConstant(1.0 / static_cast<double>(m));
  }
  Dual dual(oracle, model, rows);
  const Newton newton = Maximiser(dual, rows, model.margin, tolerance).run(std::move(v), patience);
  DualPoint point;
  point.q = newton.value.q;
  point.s = newton.value.support.moments;
  point.multipliers = newton.v.tail(m);
  point.slack = newton.slack;
  point.residual = newton.residual;
  point.ending = newton.ending == Newton::converged     ? DualPoint::converged
                 : newton.ending == Newton::separated   ? DualPoint::infeasible
                 : newton.ending == Newton::interrupted ? DualPoint::interrupted
                                                        : DualPoint::stalled;
  for (Eigen::Index i = 0; i < m; ++i)
    point.active.push_back(rows.equality[static_cast<std::size_t>(i)] || point.multipliers[i] > 0);
  return point;
}

Rows some_of(const Rows& rows, const std::vector<Eigen::Index>& kept) {
  Rows some;
  some.matrix = rows.matrix(kept, Eigen::all);
  some.bound = rows.bound(kept);
  for (const Eigen::Index i : kept) some.equality.push_back(rows.equality[static_cast<std::size_t>(i)]);
  return some;
}

/// A margin that leaves room for many fillings is reached by all of them, and the dual ends at q = 0, where
/// it has a kink. So that one of them is the answer: the one that lies closest to some point, in a metric
/// that no row happens to share.
QuadraticModel with_a_preference(const QuadraticModel& model) {
  Moments form;
  form << 0, -0.31, -0.17, -0.53, 0.13, 0.11, -0.07, 0.9, 1.1, 1.0;
  QuadraticModel preferring = model;
  preferring.linear += 1e-7 * form;  // costs the margin about as much
  return preferring;
}

/// minimise_with() for a linear model whose plane ends up along the rays: it is undecided over whole rays, of
/// which the rows need a part, and no multipliers say which. Of the many answers, that of the least szz: with
/// weight * z^2 added, whatever the multipliers, q is zero all along no ray. The weight shrinks from where
/// Newton's method sees whole rays to where it costs nothing, each step from where the last two lead.
/// [docs/quadric.md, s. 3]
DualPoint minimise_along_rays(TotalSupport& oracle, const QuadraticModel& model, const Rows& rows,
                              const Vector& start, double tolerance) {
  constexpr double shrink = 0.1, least = 1e-6;
  const double size = model.linear.cwiseAbs().maxCoeff();
  Vector from = start, before;
  DualPoint point;
  for (double weight = shrink; weight >= 0.99 * least; weight *= shrink) {
    QuadraticModel lowering = model;
    lowering.linear[SZZ] += weight * size;
    point = minimise_with(oracle, lowering, rows, from, tolerance);
    if (point.ending == DualPoint::infeasible || point.ending == DualPoint::interrupted) break;
    from = point.multipliers;
    if (before.size()) from += shrink * (point.multipliers - before);
    before = point.multipliers;
  }
  return point;
}

}  // namespace

DualPoint minimise_model(TotalSupport& oracle, const QuadraticModel& model, const Rows& rows,
                         const Vector& start, double tolerance) {
  // A base may have hundreds of edges, of which two or three count: rows join
  // as they are violated.
  constexpr Eigen::Index few = 6;
  std::vector<bool> in(static_cast<std::size_t>(rows.size()));
  for (std::size_t i = 0; i < in.size(); ++i)
    in[i] = rows.equality[i] || rows.size() <= few ||
            (start.size() == rows.size() && start[static_cast<Eigen::Index>(i)] > 0);
  // The `count` rows left out that `s` violates most, by more than `slack`.
  const auto join = [&](const Moments& s, double slack, int count) {
    const Vector excess = rows.matrix * s - rows.bound;
    bool joined = false;
    for (; count > 0; --count) {
      Eigen::Index worst = -1;
      for (Eigen::Index i = 0; i < rows.size(); ++i)
        if (!in[static_cast<std::size_t>(i)] && excess[i] > slack && (worst < 0 || excess[i] > excess[worst]))
          worst = i;
      if (worst < 0) break;
      in[static_cast<std::size_t>(worst)] = joined = true;
    }
    return joined;
  };
  const double infinity = std::numeric_limits<double>::infinity();
  if (model.margin && std::ranges::count(in, true) < 3)
    join(oracle(model.linear + rows.matrix.colwise().sum().transpose() / double(rows.size()), false).moments,
         -infinity, 3);
  const bool linear = !model.margin && model.factor.cols() == 0;  // the dual may be piecewise linear
  Vector known = start;
  for (;;) {
    std::vector<Eigen::Index> kept;
    for (std::size_t i = 0; i < in.size(); ++i)
      if (in[i]) kept.push_back(static_cast<Eigen::Index>(i));
    const Vector from = known.size() == rows.size() ? Vector(known(kept)) : Vector();
    DualPoint point =
        minimise_with(oracle, model, some_of(rows, kept), from, tolerance, linear ? 8 : most_steps);
    if (model.margin && point.ending == DualPoint::stalled)
      point = minimise_with(oracle, with_a_preference(model), some_of(rows, kept), from, tolerance);
    else if (linear && point.ending == DualPoint::stalled && point.residual > 1e3 * tolerance)
      point = minimise_along_rays(oracle, model, some_of(rows, kept), from, tolerance);
    known.setZero(rows.size());
    known(kept) = point.multipliers;
    point.multipliers = known;
    std::vector<bool> active(in.size());
    for (std::size_t i = 0; i < kept.size(); ++i) active[static_cast<std::size_t>(kept[i])] = point.active[i];
    point.active = std::move(active);
    if (point.ending == DualPoint::infeasible || point.ending == DualPoint::interrupted ||
        !join(point.s, point.slack + 10 * tolerance, 2))
      return point;
  }
}

}  // namespace kreisel::core
