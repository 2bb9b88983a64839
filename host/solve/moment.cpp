#include "solve/moment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "settings/field_text.hpp"
#include "solve/dense.hpp"
#include "solve/second_order.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

using State = MomentPoint;

class Search {
 public:
  Search(const Problem& problem, TotalSupport& oracle, double tolerance, std::vector<Iterate>& history)
      : problem_(problem),
        oracle_(oracle),
        rows_(rows_of(problem.constraints(), problem.goal() == Goal::margin)),
        tolerance_(tolerance),
        history_(history) {}

  /// From `state` to the optimum. @param known  `state` comes from a coarser level: Newton first
  Phase run(State& state, bool known, int most_steps);

 private:
  [[nodiscard]] bool margin() const { return problem_.goal() == Goal::margin; }
  Phase model_step(State& state, bool first);
  /// @param descending  only to where f is no larger
  Phase newton(State& state, bool descending);
  /// What of f a miss of the rows may be worth.
  [[nodiscard]] double worth_of_misses(const Moments& s, const Eigen::VectorXd& multipliers) const {
    return multipliers.size() ? multipliers.lpNorm<1>() * rows_.violation(s) : 0;
  }
  void note(const State& state, int trials);

  const Problem& problem_;
  TotalSupport& oracle_;
  Rows rows_;
  double tolerance_;
  std::vector<Iterate>& history_;
  bool solved_ = true;  ///< the last model
};

void Search::note(const State& state, int trials) {
  history_.push_back({static_cast<int>(history_.size()), problem_.value(state.s), rows_.violation(state.s),
                      state.residual, 0, 0, trials});
}

/// Minimises the convex part of f's quadratic model over all attainable moments that meet the rows, and goes
/// from s towards the minimiser as far as f falls. Between attainable moments lie attainable moments, so that
/// costs no pass over the rays.
Phase Search::model_step(State& state, bool first) {
  QuadraticModel model;
  model.margin = margin();
  if (!margin()) {
    model.linear = problem_.gradient(state.s);
    const SymmetricModes modes = symmetric_modes(problem_.hessian(state.s));
    std::vector<Eigen::Index> convex;
    for (Eigen::Index i = 0; i < 10; ++i)
      if (modes.values[i] > 1e-10 * modes.values.cwiseAbs().maxCoeff()) convex.push_back(i);
    const auto count = static_cast<Eigen::Index>(convex.size());
    model.factor.resize(10, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Index mode = convex[static_cast<std::size_t>(i)];
      model.factor.col(i) = modes.vectors.col(mode) * std::sqrt(modes.values[mode]);
    }
    model.target = model.factor.transpose() * state.s;
  }
  // A model need not be solved better than it describes f; the last steps belong to newton(). As Newton's
  // method squares what is left, this saves one or two passes a model.
  const bool exact = margin() || problem_.hessian(state.s).isZero();
  const double tolerance = exact ? tolerance_ : std::clamp(1e-2 * state.residual, tolerance_, 1e-4);
  const DualPoint point = minimise_model(oracle_, model, rows_, state.multipliers, tolerance);
  if (point.ending == DualPoint::infeasible) {
    state.q = rows_.matrix.transpose() * point.multipliers;
    state.curvature.reset();
    state.s = point.s;
    state.multipliers = point.multipliers;
    return Phase::infeasible;
  }
  if (point.ending == DualPoint::interrupted) return Phase::interrupted;
  const Moments step = point.s - state.s;
  double alpha = 1;
  int trials = 1;
  if (!first && !exact) {
    // Neither end meets the rows better than its model was solved.
    const auto merit = [&](const Moments& s) {
      return problem_.value(s) + worth_of_misses(s, point.multipliers);
    };
    const double before = merit(state.s), slope = model.linear.dot(step);
    while (trials < 40 && !(merit(state.s + alpha * step) <= before + 1e-4 * alpha * std::min(slope, 0.0)))
      alpha /= 2, ++trials;
  }
  state.s += alpha * step;
  state.multipliers = point.multipliers;
  state.active = point.active;
  solved_ = point.ending == DualPoint::converged || point.residual <= 1e-4;
  state.q = point.q;
  state.curvature.reset();
  state.residual = exact ? point.residual : step.lpNorm<Eigen::Infinity>();
  note(state, trials);
  // With room to spare a margin's quadric is tiny, and so round-off is large beside it (dual.cpp).
  if (exact)
    return state.residual <= (margin() ? 1e-8 : 1e3 * tolerance_) ? Phase::converged : Phase::stalled;
  return Phase::going_on;
}

/// Newton's method on s = s(grad f(s) + rows^T multipliers) and the active rows, all at once; ends when it no
/// longer reduces the residual. Changes `state` only for the better.
Phase Search::newton(State& state, bool descending) {
  const State start = state;
  std::vector<Eigen::Index> active;
  for (Eigen::Index i = 0; i < rows_.size(); ++i)
    if (state.active.empty() || state.active[static_cast<std::size_t>(i)]) active.push_back(i);
  const auto m = static_cast<Eigen::Index>(active.size());
  const Eigen::Matrix<double, Eigen::Dynamic, 10> c = rows_.matrix(active, Eigen::all);
  const Eigen::VectorXd b = rows_.bound(active);
  Moments s = state.s;
  Eigen::VectorXd mu =
      state.multipliers.size() ? Eigen::VectorXd(state.multipliers(active)) : Eigen::VectorXd::Zero(m);
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 30; ++step) {
    const Moments q = problem_.gradient(s) + c.transpose() * mu;
    const Support support = oracle_(q, true);
    Eigen::VectorXd rest(10 + m);
    rest << s - support.moments, c * s - b;
    // What counts is the part the quadric cuts, so the rows are judged there as well.
    const double missed = m ? (c * support.moments - b).lpNorm<Eigen::Infinity>() : 0;
    const double residual = std::max(rest.lpNorm<Eigen::Infinity>(), missed);
    bool fits = support.moments.allFinite();
    for (Eigen::Index i = 0; i < m; ++i)
      fits = fits &&
             (rows_.equality[static_cast<std::size_t>(active[static_cast<std::size_t>(i)])] || mu[i] >= 0);
    if (fits && residual < state.residual) {
      state.s = support.moments;
      state.q = q;
      state.curvature = support.hessian;
      state.residual = residual;
      state.multipliers.setZero(rows_.size());
      state.multipliers(active) = mu;
      note(state, 1);
    }
    if (residual <= tolerance_) break;
    if (!(residual < 0.9 * before) && step > 0) break;
    before = residual;
    Eigen::MatrixXd system(10 + m, 10 + m);
    system << Matrix10::Identity() - support.hessian * problem_.hessian(s), -support.hessian * c.transpose(),
        c, Eigen::MatrixXd::Zero(m, m);
    // Of least norm, for a symmetric body leaves multipliers undetermined.
    const Eigen::VectorXd d = shortest_solution(system, -rest);
    s += d.head<10>();
    mu += d.tail(m);
  }
  // Far from the optimum it may have found a maximum.
  if (descending && !(problem_.value(state.s) <=
                      problem_.value(start.s) + worth_of_misses(start.s, start.multipliers) + 1e-9))
    state = start;
  // Round-off: a sum over the rays keeps some thousand units of its last digit.
  return state.residual <= 1e3 * tolerance_ && rows_.violation(state.s) <= 1e3 * tolerance_ ? Phase::converged
                                                                                            : Phase::going_on;
}

Phase Search::run(State& state, bool known, int most_steps) {
  // Models that are not solved, one after the other, lead nowhere.
  constexpr int most_unsolved = 5;
  for (int step = 0, unsolved = 0; step < most_steps && unsolved < most_unsolved; ++step) {
    if (known || state.residual < 3e-2) {
      const Phase phase = margin() ? Phase::going_on : newton(state, !known);
      if (phase == Phase::converged) return phase;
    }
    // What does not meet the rows is left at once; from what does, f guides the step.
    const bool off = known && rows_.violation(state.s) > 1e-6;
    const Phase phase = model_step(state, step == 0 && (!known || off));
    known = false;
    if (phase != Phase::going_on) return phase;
    unsolved = solved_ ? 0 : unsolved + 1;
  }
  return Phase::stalled;
}

/// Any quadric that cuts a body of unit size.
Moments random_quadric(unsigned seed) {
  std::mt19937 engine(seed);
  // Not std::normal_distribution, whose values differ from library to library.
  const auto uniform = [&] { return 2 * static_cast<double>(engine()) / 4294967295.0 - 1; };
  Moments q;
  for (double& coefficient : q) coefficient = uniform();
  return q;
}

}  // namespace

Phase find_stationary(const Problem& problem, TotalSupport& oracle, double tolerance, int most_steps,
                      MomentPoint& point) {
  std::vector<Iterate> history;
  Search search(problem, oracle, tolerance, history);
  point.residual = std::numeric_limits<double>::infinity();
  return search.run(point, true, most_steps);
}

/// Multipliers this many times f's own derivatives mean that the part is shaped by the constraints, with a
/// sliver of freedom left. [docs/quadric.md, s. 2]
constexpr double barely_met = 1e3;

namespace {

void say_how_it_ended(Outcome& outcome, Phase phase, const State& state, const Problem& problem,
                      int fine_passes) {
  switch (phase) {
    case Phase::converged:
      outcome.termination = Termination::optimal;
      outcome.message = fmt::format("converged, residual {:.1e}, {} passes at full resolution",
                                    state.residual, fine_passes);
      if (const double size = state.multipliers.size() ? state.multipliers.cwiseAbs().maxCoeff() : 0;
          problem.goal() == Goal::value &&
          size > barely_met * problem.gradient(outcome.moments).cwiseAbs().maxCoeff())
        outcome.message += fmt::format(", multipliers of {:.0e}: the constraints can barely be met", size);
      break;
    case Phase::infeasible:
      outcome.termination = Termination::infeasible;
      outcome.message = "a quadric separates the constraints from all fillings";
      break;
    case Phase::interrupted:
      outcome.termination = Termination::interrupted;
      outcome.message = "stopped by the user";
      break;
    default:
      outcome.termination = state.residual <= 1e-6 ? Termination::acceptable : Termination::failed;
      outcome.message = fmt::format("no further progress, residual {:.1e}", state.residual);
  }
}

}  // namespace

Fields<MomentSettings> moment_fields() {
  using namespace field_text;
  return {{"tolerance", "", "residual, body units; default 1e-13, in single precision 1e-8",
           [](auto& s, auto k, auto v) { s.tolerance = positive(k, v); },
           [](auto& s) { return number_text(s.tolerance); }},
          {"levels", "", "how many levels of the domain to solve on, the coarse first; default all",
           [](auto& s, auto k, auto v) { s.levels = whole(k, v, 1); },
           [](auto& s) { return s.levels ? std::to_string(*s.levels) : std::string(); }},
          {"seed", "", "of a random quadric to start from; default from solid",
           [](auto& s, auto k, auto v) { s.seed = static_cast<unsigned>(whole(k, v, 0)); },
           [](auto& s) { return s.seed ? std::to_string(*s.seed) : std::string(); }}};
}

Outcome solve_with_moments(const Task& task, const SolverOptions& options) {
  auto own = settings_as<MomentSettings>(options.own);
  if (!own.tolerance) own.tolerance = task.device.single() ? 1e-8 : 1e-13;  // a pass has no more digits
  const double tolerance = *own.tolerance;
  SupportOracle& domain = *task.formulation.oracle();
  const Problem& problem = task.problem;
  Outcome outcome;
  outcome.settings = SettingTable(moment_fields()).in_force(own);
  task.device.reset_kernel_seconds();
  const Stopwatch watch;

  State state;
  Phase phase = Phase::stalled;
  bool known = false;
  int fine_passes = 0;
  const int levels = std::min(own.levels.value_or(domain.levels()), domain.levels());
  for (int level = levels - 1; level >= 0; --level) {
    TotalSupport oracle(domain, task.mass, level, task.stop);
    // The levels differ by far more than this.
    constexpr double coarse_tolerance = 1e-6;
    Search search(problem, oracle, level == 0 ? tolerance : coarse_tolerance, outcome.history);
    if (!known) {
      state = {};
      Moments from = -Moments::Unit(S1);  // solid
      if (options.from.size() == 10)
        from = Moments(options.from.data());
      else if (own.seed)
        from = random_quadric(*own.seed);
      state.s = oracle(from, false).moments;
    }
    state.residual = std::numeric_limits<double>::infinity();
    constexpr int most_steps = 200;
    phase = search.run(state, known, most_steps);
    known = phase == Phase::converged;
    outcome.evaluations.objective += oracle.passes();
    outcome.evaluations.hessian += oracle.hessian_passes();
    if (level == 0) fine_passes = oracle.passes() + oracle.hessian_passes();
    if (phase == Phase::interrupted) break;
  }

  const Moments x = state.q / std::max(state.q.cwiseAbs().maxCoeff(), 1e-300);
  outcome.x.assign(x.data(), x.data() + 10);
  outcome.moments = task.total(outcome.x);
  ++outcome.evaluations.objective, ++fine_passes;
  outcome.objective = problem.value(outcome.moments);
  outcome.violation = violation(problem, outcome.moments);
  outcome.dual_infeasibility = state.residual;
  outcome.multipliers.assign(state.multipliers.begin(), state.multipliers.end());
  outcome.iterations = static_cast<int>(outcome.history.size());
  outcome.solve_seconds = watch.seconds();
  outcome.kernel_seconds = task.device.kernel_seconds();
  if (phase == Phase::converged) {
    TotalSupport oracle(domain, task.mass, 0);
    outcome.local_minimum = second_order(problem, oracle, state, tolerance);
    outcome.evaluations.hessian += oracle.hessian_passes();
  }
  say_how_it_ended(outcome, phase, state, problem, fine_passes);
  return outcome;
}

}  // namespace kreisel::core
