#include "solve/dual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solve/interrupt.hpp"

namespace kreisel {

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

/// The dual as a function of v = (p, multipliers of the rows in play).
class Dual {
 public:
  Dual(TotalSupport& oracle, const Model& model, const Rows& rows, std::vector<Eigen::Index> in_play)
      : oracle_(oracle), model_(model), rows_(rows), in_play_(std::move(in_play)) {
    const auto m = static_cast<Eigen::Index>(in_play_.size());
    forms_.resize(10, squares() + m);
    forms_.leftCols(squares()) = model.factor;
    offsets_.resize(squares() + m);
    offsets_.head(squares()) = model.target;
    for (Eigen::Index i = 0; i < m; ++i) {
      forms_.col(squares() + i) = rows.matrix.row(in_play_[static_cast<std::size_t>(i)]).transpose();
      offsets_[squares() + i] = rows.bound[in_play_[static_cast<std::size_t>(i)]];
    }
  }

  [[nodiscard]] Eigen::Index squares() const { return model_.factor.cols(); }
  [[nodiscard]] Eigen::Index size() const { return forms_.cols(); }
  [[nodiscard]] const std::vector<Eigen::Index>& in_play() const { return in_play_; }
  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const Rows& rows() const { return rows_; }

  struct Value {
    Moments q;
    Support support;
    Vector gradient;  ///< of the dual in v
  };

  [[nodiscard]] Value at(const Vector& v) {
    Value value;
    value.q = model_.linear + forms_ * v;
    value.support = oracle_(value.q, true);
    value.gradient = forms_.transpose() * value.support.moments - offsets_;
    value.gradient.head(squares()) -= v.head(squares());
    return value;
  }
  /// Do these multipliers separate the rows from the attainable moments? Then no filling meets them.
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
  const Model& model_;
  const Rows& rows_;
  std::vector<Eigen::Index> in_play_;
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

/// Maximises the dual plus barrier * sum of log v_i over inequalities, by Newton's method from v. Without
/// barrier every multiplier is free.
Newton maximise(Dual& dual, Vector v, double barrier, double tolerance, int most_steps) {
  const Eigen::Index n = dual.size(), squares = dual.squares();
  const auto bounded = [&](Eigen::Index i) {
    return barrier > 0 && i >= squares &&
           !dual.rows().equality[static_cast<std::size_t>(
               dual.in_play()[static_cast<std::size_t>(i - squares)])];
  };
  // A margin's multipliers sum to one, and so they stay: one more row and column, whose unknown is t.
  const Eigen::Index more = dual.model().margin ? 1 : 0;
  const auto gradient_at = [&](const Vector& at, const Dual::Value& value) {
    Vector g = value.gradient;
    for (Eigen::Index i = squares; i < n; ++i)
      if (bounded(i)) g[i] += barrier / at[i];
    return g;
  };
  Newton out;
  out.v = std::move(v);
  out.value = dual.at(out.v);
  double best = std::numeric_limits<double>::infinity();
  int without_progress = 0;
  double checked = 10;  // size of the multipliers when they were last asked whether they separate
  for (int step = 0;; ++step) {
    const Vector g = gradient_at(out.v, out.value);
    Matrix system = Matrix::Zero(n + more, n + more);
    system.topLeftCorner(n, n) = -dual.hessian(out.value);
    for (Eigen::Index i = squares; i < n; ++i)
      if (bounded(i)) system(i, i) += barrier / (out.v[i] * out.v[i]);
    // Directions in which no ray ends are flat: a little of the largest curvature keeps the step finite.
    const double damping = std::max(n ? 1e-14 * system.diagonal().head(n).maxCoeff() : 0.0, 1e-12);
    system.diagonal().head(n).array() += damping;
    Vector right = Vector::Zero(n + more);
    right.head(n) = g;
    if (more) {
      system.row(n).segment(squares, n - squares).setOnes();
      system.col(n).segment(squares, n - squares).setOnes();
    }
    const Vector solution = more ? Vector(system.fullPivLu().solve(right)) : Vector(system.ldlt().solve(right));
    const Vector d = solution.head(n);
    if (more) out.slack = solution[n];
    // Of the optimality conditions.
    Vector rest = g;
    if (more) rest.tail(n - squares).array() -= out.slack;
    out.residual = n ? rest.lpNorm<Eigen::Infinity>() : 0;
    if (out.residual <= tolerance) {
      out.ending = Newton::converged;
      return out;
    }
    if (interrupted()) {
      out.ending = Newton::interrupted;
      return out;
    }
    without_progress = out.residual < 0.7 * best ? 0 : without_progress + 1;
    best = std::min(best, out.residual);
    // Round-off has been reached.
    if (without_progress >= 4 && best < 1e3 * tolerance) return out;
    if (step == most_steps || !d.allFinite()) return out;

    // No further than what is known: far out the dual may be flat.
    const double reach = 4 * std::max(1.0, out.v.lpNorm<Eigen::Infinity>());
    double alpha = std::min(1.0, reach / std::max(d.lpNorm<Eigen::Infinity>(), 1e-300));
    for (Eigen::Index i = squares; i < n; ++i)
      if (bounded(i) && d[i] < 0) alpha = std::min(alpha, -0.95 * out.v[i] / d[i]);
    // The dual is concave: a step after which it still rises has gained, one after which it falls less steeply
    // than it rose before is good enough. Slopes keep their digits where values have lost them.
    const double rise = g.dot(d);
    double low = 0, low_slope = rise;
    for (int trial = 0; trial < 30; ++trial) {
      const Vector at = out.v + alpha * d;
      const Dual::Value value = dual.at(at);
      const double slope = gradient_at(at, value).dot(d);
      const bool good = slope >= -0.5 * std::abs(rise) || trial == 29;
      if (good) {
        out.v = at;
        out.value = value;
        break;
      }
      // Between the last point where it rose and this one where it falls.
      const double secant = low + (alpha - low) * low_slope / (low_slope - slope);
      alpha = std::clamp(secant, low + 0.05 * (alpha - low), low + 0.7 * (alpha - low));
    }
    if (const double size = n > squares ? out.v.tail(n - squares).lpNorm<Eigen::Infinity>() : 0;
        !more && size > 4 * checked) {
      checked = size;
      if (dual.separates(out.v)) {
        out.ending = Newton::separated;
        return out;
      }
    }
  }
}

}  // namespace

DualPoint minimise_model(TotalSupport& oracle, const Model& model, const Rows& rows, const Vector& start,
                         double tolerance) {
  const Eigen::Index m = rows.size(), squares = model.factor.cols();
  std::vector<Eigen::Index> everything(static_cast<std::size_t>(m)), held;
  for (Eigen::Index i = 0; i < m; ++i) {
    everything[static_cast<std::size_t>(i)] = i;
    if (rows.equality[static_cast<std::size_t>(i)]) held.push_back(i);
  }
  const auto point_of = [&](const Newton& newton, const std::vector<Eigen::Index>& in_play) {
    DualPoint point;
    point.q = newton.value.q;
    point.s = newton.value.support.moments;
    point.multipliers.setZero(m);
    point.active.assign(static_cast<std::size_t>(m), false);
    for (std::size_t i = 0; i < in_play.size(); ++i) {
      point.multipliers[in_play[i]] = newton.v[squares + static_cast<Eigen::Index>(i)];
      point.active[static_cast<std::size_t>(in_play[i])] = true;
    }
    point.residual = newton.residual;
    point.ending = newton.ending == Newton::converged     ? DualPoint::converged
                   : newton.ending == Newton::separated   ? DualPoint::infeasible
                   : newton.ending == Newton::interrupted ? DualPoint::interrupted
                                                          : DualPoint::stalled;
    return point;
  };
  constexpr int most_steps = 100;

  Vector v = Vector::Zero(squares + m);
  if (start.size() == m) v.tail(m) = start;
  Dual all(oracle, model, rows, everything);
  if (held.size() == everything.size()) return point_of(maximise(all, v, 0, tolerance, most_steps), everything);

  for (Eigen::Index i = 0; i < m; ++i)
    if (!rows.equality[static_cast<std::size_t>(i)])
      v[squares + i] = model.margin ? 1.0 / static_cast<double>(m) : std::max(v[squares + i], 0.1);
  DualPoint last;
  for (double barrier = 0.1; barrier > 1e-13; barrier *= 0.1) {
    const Newton rough = maximise(all, v, barrier, std::max(0.1 * barrier, tolerance), most_steps);
    last = point_of(rough, everything);
    if (last.ending == DualPoint::infeasible || last.ending == DualPoint::interrupted) return last;
    v = rough.v;
    if (barrier > 1e-3) continue;
    // Those whose multiplier outweighs their slack are taken to be active, and held as equalities.
    const Vector slack = (rows.bound - rows.matrix * last.s).array() + rough.slack;
    std::vector<Eigen::Index> active = held;
    for (Eigen::Index i = 0; i < m; ++i)
      if (!rows.equality[static_cast<std::size_t>(i)] && v[squares + i] > slack[i]) active.push_back(i);
    std::ranges::sort(active);
    Dual some(oracle, model, rows, active);
    Vector from(squares + static_cast<Eigen::Index>(active.size()));
    from.head(squares) = v.head(squares);
    for (std::size_t i = 0; i < active.size(); ++i)
      from[squares + static_cast<Eigen::Index>(i)] = v[squares + active[i]];
    if (model.margin) from.tail(from.size() - squares) /= from.tail(from.size() - squares).sum();
    const Newton fine = maximise(some, from, 0, tolerance, 20);
    DualPoint point = point_of(fine, active);
    const double met = std::max(10 * tolerance, 10 * point.residual);
    bool right = point.residual <= 1e3 * tolerance;
    const Vector excess = (rows.matrix * point.s - rows.bound).array() - fine.slack;
    for (Eigen::Index i = 0; i < m; ++i)
      if (!rows.equality[static_cast<std::size_t>(i)])
        right = right && point.multipliers[i] >= 0 && excess[i] <= met;
    if (right) return point;
  }
  return last;
}

}  // namespace kreisel
