#include "solve/slsqp.hpp"

#include <fmt/format.h>
#include <nlopt.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <future>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "error.hpp"
#include "settings/field_text.hpp"
#include "solve/nlp.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

/// What every solver meets, in body units; a result that misses more did not meet the constraints.
constexpr double met = 1e-6;

double largest(std::span<const double> values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most > 0 ? most : 1;
}

/// The direct form of a task as NLopt asks for it. NLopt is C: no exception may pass through it.
class Functions {
 public:
  using Index = Nlp::Index;

  Functions(Nlp& nlp, nlopt_opt opt, double reach, std::stop_token asked)
      : stop(std::move(asked)), nlp_(nlp), opt_(opt) {
    Ipopt::TNLP::IndexStyleEnum style{};
    Index hessian = 0;
    nlp_.get_nlp_info(n_, m_, entries_, hessian, style);
    lower.resize(n_);
    upper.resize(n_);
    x.resize(n_);
    std::vector<double> rows_lower(m_), rows_upper(m_), gradient(n_);
    nlp_.get_bounds_info(n_, lower.data(), upper.data(), m_, rows_lower.data(), rows_upper.data());
    for (std::vector<double>* bounds : {&lower, &upper})
      for (double& bound : *bounds)
        if (std::abs(bound) >= nowhere) bound = std::copysign(HUGE_VAL, bound);
    nlp_.get_starting_point(n_, true, x.data(), false, nullptr, nullptr, m_, false, nullptr);

    // Its model starts from the identity: derivatives of about one suit that.
    nlp_.eval_grad_f(n_, x.data(), true, gradient.data());
    scale_ = reach / largest(gradient);
    row_.resize(entries_);
    column_.resize(entries_);
    nlp_.eval_jac_g(n_, x.data(), true, m_, entries_, row_.data(), column_.data(), nullptr);
    const Eigen::MatrixXd start = jacobian(x.data());
    for (Index r = 0; r < m_; ++r) {
      const double unit = 1 / largest({start.col(r).data(), static_cast<std::size_t>(n_)});
      if (rows_lower[r] == rows_upper[r])
        equal.sides.push_back({r, unit, rows_lower[r]});
      else {
        if (rows_upper[r] < nowhere) below.sides.push_back({r, unit, rows_upper[r]});
        if (rows_lower[r] > -nowhere) below.sides.push_back({r, -unit, rows_lower[r]});
      }
    }
  }

  static double objective(unsigned, const double* at, double* gradient, void* self) {
    auto& f = *static_cast<Functions*>(self);
    double value = std::numeric_limits<double>::quiet_NaN();
    f.guarded([&] {
      f.nlp_.eval_f(f.n_, at, true, value);
      f.history.push_back({static_cast<int>(f.history.size()), value, 0, 0, 0, 0, 0});
      value *= f.scale_;
      if (!gradient) return;
      f.nlp_.eval_grad_f(f.n_, at, true, gradient);
      for (Index i = 0; i < f.n_; ++i) gradient[i] *= f.scale_;
    });
    return value;
  }

  /// Some sides of the rows of constraints: factor (g_row - bound), which is to be <= 0 or = 0.
  struct Sides {
    struct Side {
      Index row;
      double factor, bound;
    };
    Functions* of;
    std::vector<Side> sides{};
  };

  static void constraints(unsigned, double* result, unsigned, const double* at, double* gradient,
                          void* which) {
    const Sides& rows = *static_cast<const Sides*>(which);
    Functions& f = *rows.of;
    f.guarded([&] {
      std::vector<double> g(f.m_);
      f.nlp_.eval_g(f.n_, at, true, f.m_, g.data());
      for (const auto& [row, factor, bound] : rows.sides) *result++ = factor * (g[row] - bound);
      if (!gradient) return;
      const Eigen::MatrixXd slopes = f.jacobian(at);
      for (const auto& [row, factor, bound] : rows.sides)
        for (Index i = 0; i < f.n_; ++i) *gradient++ = factor * slopes(i, row);
    });
  }

  /// From now on nothing is asked of the task; waits for what is being asked.
  void leave() {
    const std::scoped_lock lock(asking_);
    left_ = true;
  }

  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

  std::stop_token stop;
  std::vector<double> lower, upper, x;
  Sides equal{this}, below{this};
  std::vector<Iterate> history;

 private:
  static constexpr double nowhere = 1e19;  ///< as the form's bounds say that there is none

  template <class Work>
  void guarded(Work work) {
    const std::scoped_lock lock(asking_);
    if (left_ || stop.stop_requested()) {
      nlopt_force_stop(opt_);
      return;
    }
    try {
      work();
    } catch (...) {
      if (!thrown_) thrown_ = std::current_exception();
      nlopt_force_stop(opt_);
    }
  }

  /// A column a row of constraints.
  [[nodiscard]] Eigen::MatrixXd jacobian(const double* at) {
    std::vector<double> values(entries_);
    nlp_.eval_jac_g(n_, at, true, m_, entries_, nullptr, nullptr, values.data());
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n_, m_);
    for (Index e = 0; e < entries_; ++e) dense(column_[e], row_[e]) += values[e];
    return dense;
  }

  Nlp& nlp_;
  nlopt_opt opt_;
  Index n_ = 0, m_ = 0, entries_ = 0;
  double scale_ = 1;
  std::vector<Index> row_, column_;
  std::exception_ptr thrown_;
  std::mutex asking_;
  bool left_ = false;
};

/// @throws std::bad_alloc, std::logic_error  what NLopt refuses is a fault of ours
void require(nlopt_result result) {
  if (result == NLOPT_OUT_OF_MEMORY) throw std::bad_alloc();
  if (result < 0) throw std::logic_error(fmt::format("NLopt: {}", nlopt_result_to_string(result)));
}

void add(nlopt_result (*adder)(nlopt_opt, unsigned, nlopt_mfunc, void*, const double*), nlopt_opt opt,
         Functions::Sides& rows) {
  if (rows.sides.empty()) return;
  const std::vector<double> exact(rows.sides.size(), 0.0);
  require(adder(opt, static_cast<unsigned>(rows.sides.size()), Functions::constraints, &rows, exact.data()));
}

/// A solve of NLopt, with all that it uses.
struct SlsqpSearch {
  SlsqpSearch(const Task& task, const SolverOptions& options, const SlsqpSettings& own)
      : nlp(make_direct_nlp(task,
                            options.from.empty() ? task.formulation.start(options.start) : options.from)),
        opt(create(*nlp)),
        functions(*nlp, opt.get(), options.reach.value_or(1.0), task.stop) {
    require(nlopt_set_lower_bounds(opt.get(), functions.lower.data()));
    require(nlopt_set_upper_bounds(opt.get(), functions.upper.data()));
    require(nlopt_set_min_objective(opt.get(), Functions::objective, &functions));
    require_enough_cells();
    add(nlopt_add_equality_mconstraint, opt.get(), functions.equal);
    add(nlopt_add_inequality_mconstraint, opt.get(), functions.below);
    require(nlopt_set_ftol_rel(opt.get(), own.ftol_rel));
    require(nlopt_set_maxeval(opt.get(), own.maxeval));
  }

  /// NLopt takes no more equations than variables.
  void require_enough_cells() const {
    const unsigned cells = nlopt_get_dimension(opt.get());
    if (const std::size_t equations = functions.equal.sides.size(); equations > cells)
      throw InputError(
          fmt::format("solver 'slsqp' with {} cells for {} equations; expected as many cells at least: a "
                      "higher --level, or solver ipopt",
                      cells, equations));
  }

  using Optimiser = std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)>;
  static Optimiser create(Nlp& nlp) {
    Ipopt::Index n = 0, m = 0, entries = 0, hessian = 0;
    Ipopt::TNLP::IndexStyleEnum style{};
    nlp.get_nlp_info(n, m, entries, hessian, style);
    Optimiser opt(nlopt_create(NLOPT_LD_SLSQP, static_cast<unsigned>(n)), nlopt_destroy);
    if (!opt) throw std::bad_alloc();
    return opt;
  }

  Ipopt::SmartPtr<Nlp> nlp;
  Optimiser opt;
  Functions functions;
};

struct Found {
  nlopt_result result;
  std::vector<double> x;
};

/// An iteration of many cells takes NLopt half a minute, in which it can't be stopped. So it has a thread of
/// its own, which Ctrl-C leaves behind: that ends where it would ask for the next value, or with the program.
Found optimise(const std::shared_ptr<SlsqpSearch>& search) {
  std::packaged_task<Found()> work([search, x = search->functions.x]() mutable {
    double scaled = 0;
    const nlopt_result result = nlopt_optimize(search->opt.get(), x.data(), &scaled);
    return Found{result, std::move(x)};
  });
  std::future<Found> found = work.get_future();
  std::thread thread(std::move(work));
  while (found.wait_for(std::chrono::milliseconds(50)) == std::future_status::timeout)
    if (search->functions.stop.stop_requested()) {
      search->functions.leave();
      thread.detach();
      return {NLOPT_FORCED_STOP, search->functions.x};
    }
  thread.join();
  return found.get();
}

/// Termination and NLopt's reason, of a result that misses the constraints by `violation`.
void judge(nlopt_result result, Outcome& outcome) {
  const auto say = [&](Termination termination, std::string_view why) {
    outcome.termination = termination;
    outcome.message = why;
  };
  switch (result) {
    case NLOPT_OUT_OF_MEMORY:
      throw std::bad_alloc();
    case NLOPT_FORCED_STOP:
      return say(Termination::interrupted, "stopped by the user");
    case NLOPT_MAXEVAL_REACHED:
      return say(Termination::failed, "maximum number of evaluations exceeded");
    default:
      break;
  }
  if (outcome.violation > met)
    return say(
        Termination::infeasible,
        fmt::format("misses the constraints by {:.2e}, and no step brings them nearer", outcome.violation));
  if (result == NLOPT_ROUNDOFF_LIMITED) return say(Termination::acceptable, "limited by round-off");
  if (result < 0) return say(Termination::failed, nlopt_result_to_string(result));
  say(Termination::optimal, "the objective no longer changes");
}

}  // namespace

Fields<SlsqpSettings> slsqp_fields() {
  using namespace field_text;
  return {{"ftol_rel", "", "relative change of the objective at which it stops; default 1e-10",
           [](auto& s, auto k, auto v) {
             s.ftol_rel =
                 number_where(k, v, "a number between 0 and 1", [](double f) { return f > 0 && f < 1; });
           },
           [](auto& s) { return number_text(s.ftol_rel); }},
          {"maxeval", "", "evaluations of the objective at most; default 500",
           [](auto& s, auto k, auto v) { s.maxeval = whole(k, v, 1); },
           [](auto& s) { return std::to_string(s.maxeval); }}};
}

Outcome solve_with_slsqp(const Task& task, const SolverOptions& options) {
  const SlsqpSettings own = settings_as<SlsqpSettings>(options.own);
  if (const std::size_t n = task.formulation.num_variables(); n > slsqp_most_variables)
    throw InputError(
        fmt::format("solver 'slsqp' with {} cells; expected {} at most, as its memory grows with their "
                    "square and its time "
                    "with their cube: a lower --level, or solver ipopt",
                    n, slsqp_most_variables));
  Outcome outcome;
  task.device.reset_kernel_seconds();
  const Stopwatch watch;
  const auto search = std::make_shared<SlsqpSearch>(task, options, own);
  Functions& functions = search->functions;
  auto [result, x] = optimise(search);
  functions.rethrow();
  x.resize(task.formulation.num_variables());
  const Bounds& bounds = task.formulation.bounds();
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::clamp(x[i], bounds.lower[i], bounds.upper[i]);
  outcome.x = std::move(x);
  outcome.moments = task.total(outcome.x);
  outcome.objective = task.problem.value(outcome.moments);
  outcome.violation = violation(task.problem, outcome.moments);
  judge(result, outcome);
  outcome.history = std::move(functions.history);
  outcome.iterations = static_cast<int>(outcome.history.size()) - 1;
  outcome.evaluations = search->nlp->evaluations();
  outcome.settings = SettingTable(slsqp_fields()).in_force(own);
  outcome.solve_seconds = watch.seconds();
  outcome.kernel_seconds = task.device.kernel_seconds();
  return outcome;
}

}  // namespace kreisel::core
