#include "solve/ipopt.hpp"

#include <IpoptConfig.h>
#include <fmt/format.h>

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <new>
#include <utility>

#include "error.hpp"
#include "memory.hpp"
#include "nearest.hpp"
#include "solve/linear_algebra.hpp"
#include "solve/nlp.hpp"
#include "stopwatch.hpp"

namespace kreisel {
namespace {

using Settings = std::map<std::string, std::string>;

/// Ipopt's options before the user's own, and the reach of natural_scale(); found by measuring
/// (docs/rayrep.md).
struct Defaults {
  Settings settings;
  double reach;
};

/// `linear`: of the moments in the variables; `exact`: the lifted form.
Defaults defaults_for(bool linear, bool exact) {
  // MUMPS' own ordering wants tens of gigabytes for the arrow-shaped systems of the voxel formulation;
  // approximate minimum degree (0) takes the diagonal first. tol is relative to the scaled objective; the
  // constraints have a tolerance of their own, in body units.
  Defaults d{{{"print_level", "0"},
              {"sb", "yes"},
              {"mumps_pivot_order", "0"},
              {"constr_viol_tol", "1e-9"},
              {"tol", !linear ? "1e-5"
                      : exact ? "1e-7"
                              : "1e-6"}},
             linear ? 1e-2 : 10.0};
  return d;
}

/// For a solve that goes on from another: its own start is not to be pushed off the central path.
const Settings& warm_settings() {
  static const Settings settings = {{"warm_start_init_point", "yes"},
                                    {"warm_start_bound_push", "1e-9"},
                                    {"warm_start_bound_frac", "1e-9"},
                                    {"warm_start_mult_bound_push", "1e-12"}};
  return settings;
}

template <class T>
bool parse(const std::string& text, T& value) {
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return status == std::errc() && end == text.data() + text.size();
}

void set_option(Ipopt::IpoptApplication& app, const std::string& name, const std::string& value) {
  const auto option = app.RegOptions()->GetOption(name);
  if (!IsValid(option)) {
    std::vector<std::string> names;
    for (const auto& [known, entry] : app.RegOptions()->RegisteredOptionsList()) names.push_back(known);
    const std::string meant = nearest(name, names);
    throw InputError(fmt::format("ipopt.{} = {}; Ipopt has no option of that name{}", name, value,
                                 meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant)));
  }
  bool good = false;
  int integer = 0;
  double number = 0;
  switch (option->Type()) {
    case Ipopt::OT_Integer:
      good = parse(value, integer) && option->IsValidIntegerSetting(integer) &&
             app.Options()->SetIntegerValue(name, integer);
      break;
    case Ipopt::OT_Number:
      good = parse(value, number) && option->IsValidNumberSetting(number) &&
             app.Options()->SetNumericValue(name, number);
      break;
    default:
      good = option->IsValidStringSetting(value) && app.Options()->SetStringValue(name, value);
  }
  if (!good)
    throw InputError(
        fmt::format("ipopt.{} = {} is not a value Ipopt takes: {}", name, value, option->ShortDescription()));
}

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

/// Factor on f that makes its largest derivative at the start `reach`.
///
/// One variable moves one voxel of perhaps 1e5, so f's derivatives are about 1e-5 while Ipopt's first barrier
/// parameter (0.1) and multipliers (1) take them to be about 1. Unscaled, the barrier drowns f for the first
/// iterations and the last barrier parameter leaves a gap of n * 1e-9 / 1e-5. Ipopt's own scaling only
/// shrinks.
/// The margin has no slope in x; the constraints that bound it have.
double natural_scale(const Task& task, const std::vector<double>& start, double reach) {
  const Moments s = task.mass.total(task.formulation.moments(start));
  std::vector<Moments> forms;
  if (task.problem.goal() == Goal::margin)
    for (const auto& row : task.problem.constraints().matrix.rowwise()) forms.emplace_back(row.transpose());
  else
    forms.push_back(task.problem.gradient(s));
  double largest = 0;
  const bool sizes_differ = task.formulation.refines();
  std::vector<double> gradient(start.size());
  for (Moments& form : forms) {
    form *= task.mass.contrast;
    task.formulation.pull_back(start, {&form, 1}, gradient);
    for (double& g : gradient) g = std::abs(g);
    // Where cells differ in size by powers of two, so do their derivatives by powers of eight. What counts
    // are the many small ones.
    const auto counted = sizes_differ ? gradient.begin() + gradient.size() / 2 : gradient.end() - 1;
    std::ranges::nth_element(gradient, counted);
    largest = std::max(largest, *counted);
  }
  return largest > 0 ? reach / largest : 1.0;
}

constexpr double gibi = 1 << 30;

/// What Ipopt and MUMPS take, bytes. They use some 2 kB a variable (measured: 1.8 kB a voxel, 1.6 kB an end
/// of a ray). Of limited address space all counts that they ask for: 2.3 kB, and half as much again where
/// MUMPS has to ask twice.
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

/// @param held  variables that stay at their bound, of a solve that goes on; empty: to be found
Outcome solve(const Task& task, const SolverOptions& options, std::vector<std::uint8_t> held = {}) {
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> app = new Ipopt::IpoptApplication(false);
  app->RethrowNonIpoptException(true);
  Settings settings = options.own;
  settings.insert({"hessian_approximation", "exact"});  // what the user gave stays, here and below
  const bool lifted = settings.at("hessian_approximation") == "exact";
  const bool linear = task.formulation.moments_are_linear();
  const Defaults defaults = defaults_for(linear, lifted);
  // A regulariser ties neighbours: no longer an arrow alone, but one whose dense rows are to come last.
  if (task.formulation.regulariser()) settings.insert({"mumps_pivot_order", "6"});
  settings.insert(defaults.settings.begin(), defaults.settings.end());
  // MUMPS asks for eleven times what it expects to need. That costs nothing but address space.
  if (available_memory().limited) settings.insert({"mumps_mem_percent", "50"});
  const std::vector<double> start =
      options.from.empty() ? task.formulation.start(options.start) : options.from;
  const double reach = options.reach.value_or(defaults.reach);
  settings.insert({"obj_scaling_factor", fmt::format("{:.6g}", natural_scale(task, start, reach))});
  const bool goes_on = !options.from.empty() && !options.warm.multipliers.empty();
  if (goes_on) settings.insert(warm_settings().begin(), warm_settings().end());
  for (const auto& [name, value] : settings) set_option(*app, name, value);
  // Ctrl-C is ours, so Ipopt reads no options file either: everything that counts is in the record.
  app->Options()->SetStringValue("option_file_name", "");
  if (app->Initialize("") != Ipopt::Solve_Succeeded) throw InputError("Ipopt refuses its options");

  task.device.reset_kernel_seconds();
  const Stopwatch watch;
  const Ipopt::SmartPtr<Nlp> nlp =
      lifted ? make_lifted_nlp(task, start, options.convexify) : make_direct_nlp(task, start);
  if (goes_on) {
    double scale = 1;
    app->Options()->GetNumericValue("obj_scaling_factor", scale, "");
    const double barrier = scale * nlp->go_on(options.warm, std::move(held));
    const auto [option, ours] = settings.insert({"mu_init", fmt::format("{:.6g}", barrier)});
    if (ours) set_option(*app, option->first, option->second);
  }
  const Ipopt::SmartPtr<MemoryJournal> journal = new MemoryJournal();
  app->Jnlst()->AddJournal(GetRawPtr(journal));
  const Ipopt::ApplicationReturnStatus status = app->OptimizeTNLP(GetRawPtr(nlp));
  if (status == Ipopt::Insufficient_Memory ||
      (journal->ran_out() && termination_of(status) == Termination::failed))
    throw std::bad_alloc();

  Outcome outcome;
  outcome.solve_seconds = watch.seconds();
  outcome.kernel_seconds = task.device.kernel_seconds();
  outcome.termination = termination_of(status);
  outcome.message = message_of(status);
  outcome.settings = settings;
  outcome.evaluations = nlp->evaluations();
  outcome.history = nlp->history();
  outcome.warm = nlp->warm();
  outcome.x = nlp->solution().empty() ? start : nlp->solution();
  outcome.auxiliary = nlp->auxiliary();
  outcome.moments = task.mass.total(task.formulation.moments(outcome.x));
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

}  // namespace

Outcome solve_with_ipopt(const Task& task, const SolverOptions& options) {
  const Memory memory = available_memory();
  require_memory(task, memory);
  try {
    return solve(task, options);
  } catch (const std::bad_alloc&) {
    throw too_little(task, memory, "ran out of memory in Ipopt:");
  }
}

std::string ipopt_version() { return IPOPT_VERSION; }

}  // namespace kreisel
