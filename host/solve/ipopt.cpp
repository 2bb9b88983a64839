#include "solve/ipopt.hpp"

#include <IpoptConfig.h>
#include <fmt/format.h>

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <algorithm>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <new>
#include <utility>

#include "error.hpp"
#include "memory.hpp"
#include "solve/arrow_in_ipopt.hpp"
#include "solve/ipopt_settings.hpp"
#include "solve/linear_algebra.hpp"
#include "solve/nlp.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

Termination termination_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return Termination::optimal;
    case Ipopt::Solved_To_Acceptable_Level:
      return Termination::acceptable;
    case Ipopt::Infeasible_Problem_Detected:
      return Termination::infeasible;
    case Ipopt::User_Requested_Stop:
      return Termination::interrupted;
    default:
      return Termination::failed;
  }
}

std::string message_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return "solve succeeded";
    case Ipopt::Solved_To_Acceptable_Level:
      return "solved to acceptable level";
    case Ipopt::Infeasible_Problem_Detected:
      return "converged to a point of local infeasibility";
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return "search direction becomes too small";
    case Ipopt::Maximum_Iterations_Exceeded:
      return "maximum number of iterations exceeded";
    case Ipopt::Maximum_CpuTime_Exceeded:
      return "maximum CPU time exceeded";
    case Ipopt::Restoration_Failed:
      return "restoration failed";
    case Ipopt::User_Requested_Stop:
      return "stopped by the user";
    case Ipopt::Insufficient_Memory:
      return "not enough memory";
    case Ipopt::Internal_Error:
      return "Ipopt's linear solver gave up, as it does when memory runs out";
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
      return "too few degrees of freedom";
    default:
      return fmt::format("Ipopt status {}", static_cast<int>(status));
  }
}

constexpr double gibi = 1 << 30;

/// What Ipopt and its linear solver take, bytes. With MUMPS they use some 2 kB a variable (measured: 1.8 kB a
/// voxel, 1.6 kB an end of a ray), with our own 1.3 kB; which it will be is not known yet. Of limited address
/// space all counts that they ask for: 2.3 kB, and half as much again where MUMPS has to ask twice.
double memory_for(const Task& task, bool limited) {
  const auto n = static_cast<double>(task.formulation.num_variables());
  return limited ? 3500 * n + blas_bytes : 2000 * n;
}

/// @param happened  what the variables did; the memory there is follows
MemoryError too_little(const Task& task, const Memory& memory, std::string_view happened) {
  return MemoryError(fmt::format(
      "{} with {} variables {} {} {:.3g} GiB; expected a coarser --resolution or more",
      task.formulation.name(), task.formulation.num_variables(), happened, memory.of, memory.bytes / gibi));
}

/// Asking for more than there is would end in the system's hands, not in ours.
void require_memory(const Task& task, const Memory& memory) {
  const double need = memory_for(task, memory.limited);
  if (need > memory.bytes)
    throw too_little(task, memory, fmt::format("needs about {:.3g} GiB in Ipopt and", need / gibi));
  if (memory.limited) reserve_blas_buffers();
}

/// Gives Ipopt its options, and our linear solver where it is the one.
std::unique_ptr<ArrowInIpopt> initialise(Ipopt::IpoptApplication& app, const IpoptSettings& settings) {
  std::unique_ptr<ArrowInIpopt> arrow;
  for (const auto& [name, value] : settings) {
    const bool ours = name == "linear_solver" && value == "arrow";
    set_ipopt_option(app, name, ours ? "ma27" : value);
    if (!ours) continue;
    arrow = std::make_unique<ArrowInIpopt>();
    // Its workspaces hold nothing but the values.
    app.Options()->SetNumericValue("ma27_la_init_factor", 1);
    app.Options()->SetNumericValue("ma27_liw_init_factor", 1);
  }
  // Ctrl-C is ours, so Ipopt reads no options file either: everything that counts is in the record.
  app.Options()->SetStringValue("option_file_name", "");
  if (app.Initialize("") != Ipopt::Solve_Succeeded) throw InputError("Ipopt refuses its options");
  return arrow;
}

/// @param held  variables that stay at their bound, of a solve that goes on; empty: to be found
Outcome solve(const Task& task, const SolverOptions& options, std::vector<std::uint8_t> held = {}) {
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> app = new Ipopt::IpoptApplication(false);
  app->RethrowNonIpoptException(true);
  const std::vector<double> start =
      options.from.empty() ? task.formulation.start(options.start) : options.from;
  task.device.reset_kernel_seconds();
  const Stopwatch watch;
  const Ipopt::SmartPtr<Nlp> nlp = wants_exact_hessian(task, options)
                                       ? make_lifted_nlp(task, start, options.convexify)
                                       : make_direct_nlp(task, start);
  IpoptSettings settings = ipopt_settings(task, options, *nlp, start);
  const std::unique_ptr<ArrowInIpopt> arrow = initialise(*app, settings);
  if (goes_on(options)) {
    double scale = 1;
    app->Options()->GetNumericValue("obj_scaling_factor", scale, "");
    const double barrier = scale * nlp->go_on(options.warm, std::move(held));
    const auto [option, ours] = settings.insert({"mu_init", fmt::format("{:.6g}", barrier)});
    if (ours) set_ipopt_option(*app, option->first, option->second);
  }
  const Ipopt::SmartPtr<MemoryJournal> journal = new MemoryJournal();
  app->Jnlst()->AddJournal(GetRawPtr(journal));
  const Ipopt::ApplicationReturnStatus status = app->OptimizeTNLP(GetRawPtr(nlp));
  if (status == Ipopt::Invalid_Option)
    throw InputError("Ipopt refuses its options: one of ipopt.NAME asks for what is not installed here");
  if (status == Ipopt::Insufficient_Memory ||
      (journal->ran_out() && termination_of(status) == Termination::failed))
    throw std::bad_alloc();

  Outcome outcome;
  outcome.solve_seconds = watch.seconds();
  outcome.kernel_seconds = task.device.kernel_seconds();
  outcome.termination = termination_of(status);
  outcome.message = message_of(status);
  const auto own = settings_as<IpoptSettings>(options.own);
  if (const auto asked = own.find("linear_solver"); asked != own.end() && asked->second == "arrow" && !arrow)
    outcome.message += ", by MUMPS: the systems are no arrow";
  outcome.settings = settings;
  outcome.evaluations = nlp->evaluations();
  outcome.history = nlp->history();
  outcome.warm = nlp->warm();
  outcome.x = nlp->solution().empty() ? start : nlp->solution();
  outcome.auxiliary = nlp->auxiliary();
  outcome.moments = task.total(outcome.x);
  outcome.objective = task.problem.value(outcome.moments);
  outcome.violation = violation(task.problem, outcome.moments);
  if (const auto statistics = app->Statistics(); IsValid(statistics)) {
    outcome.iterations = statistics->IterationCount();
    Ipopt::Number dual = 0, constraint = 0, complementarity = 0, kkt = 0;
    statistics->Infeasibilities(dual, constraint, complementarity, kkt);
    outcome.dual_infeasibility = dual;
    outcome.complementarity = complementarity;
  }
  if (outcome.termination == Termination::interrupted) return outcome;
  // What is held may leave too little to meet the constraints with: then nothing is.
  held = nlp->held();
  SolverOptions again = options;
  if (!outcome.converged()) {
    if (std::ranges::find(held, 1) == held.end()) return outcome;
    std::ranges::fill(held, 0);
  } else {
    const std::vector<std::uint8_t> released = nlp->released();
    if (released.empty()) return outcome;
    for (std::size_t i = 0; i < released.size(); ++i)
      if (released[i]) held[i] = 0;
    again.from = outcome.x;
    again.warm = outcome.warm;
  }
  Outcome next = solve(task, again, std::move(held));
  next.add_before(outcome);
  return next;
}

Outcome stopped_while_waiting(const Task& task, const SolverOptions& options) {
  Outcome outcome;
  outcome.termination = Termination::interrupted;
  outcome.message = "stopped by the user while another solve ran";
  outcome.x = options.from.empty() ? task.formulation.start(options.start) : options.from;
  return outcome;
}

}  // namespace

Outcome solve_with_ipopt(const Task& task, const SolverOptions& options) {
  // MUMPS of this version keeps its state in the library, and so does the hook for our linear solver.
  static std::mutex gate;
  static std::condition_variable_any left;
  static bool busy = false;
  {
    std::unique_lock lock(gate);
    if (!left.wait(lock, task.stop, [] { return !busy; })) return stopped_while_waiting(task, options);
    busy = true;
  }
  struct Leave {
    ~Leave() {
      {
        const std::lock_guard lock(gate);
        busy = false;
      }
      left.notify_one();
    }
  } const leave;
  const Memory memory = available_memory();
  require_memory(task, memory);
  try {
    return solve(task, options);
  } catch (const std::bad_alloc&) {
    throw too_little(task, memory, "ran out of memory in Ipopt:");
  }
}

std::string ipopt_version() { return IPOPT_VERSION; }

}  // namespace kreisel::core
