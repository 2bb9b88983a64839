#include "solve/ipopt_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "error.hpp"
#include "memory.hpp"
#include "solve/arrow_in_ipopt.hpp"
#include "solve/ipopt.hpp"

namespace kreisel::core {
namespace {

/// Ipopt's options before the user's own, and the reach of natural_scale(); found by measuring
/// (docs/rayrep.md).
struct Defaults {
  IpoptSettings settings;
  double reach;
};

/// `linear`: of the moments in the variables; `exact`: the lifted form.
Defaults defaults_for(bool linear, bool exact) {
  // tol is relative to the scaled objective; the constraints have a tolerance of their own, in body units.
  Defaults d{{{"print_level", "0"},
              {"sb", "yes"},
              {"constr_viol_tol", "1e-9"},
              {"tol", !linear ? "1e-5"
                      : exact ? "1e-7"
                              : "1e-6"}},
             linear ? 1e-2 : 10.0};
  return d;
}

/// Ours of MUMPS, where it is the one that solves.
IpoptSettings defaults_of_mumps(const Task& task) {
  // Its own ordering wants tens of gigabytes for the arrow-shaped systems of the voxel formulation;
  // approximate minimum degree (0) takes the diagonal first. A regulariser ties neighbours: no longer an
  // arrow alone, but one whose dense rows are to come last (6).
  IpoptSettings settings = {{"mumps_pivot_order", task.formulation.regulariser() ? "6" : "0"}};
  // MUMPS asks for eleven times what it expects to need. That costs nothing but address space.
  if (available_memory().limited) settings.insert({"mumps_mem_percent", "50"});
  return settings;
}

/// The linear solver of a solve: what was asked, or else our own where it fits.
std::string linear_solver_for(const IpoptSettings& given, Ipopt::TNLP& nlp, bool exact) {
  const auto asked = given.find("linear_solver");
  if (asked != given.end() && asked->second != "arrow") return asked->second;
  const auto of_mumps =
      std::ranges::find_if(given, [](const auto& s) { return s.first.starts_with("mumps_"); });
  if (of_mumps == given.end()) return is_arrow(nlp, exact) ? "arrow" : "mumps";
  if (asked != given.end())
    throw InputError(fmt::format("ipopt.{} = {} is nothing to ipopt.linear_solver = arrow; expected mumps",
                                 of_mumps->first, of_mumps->second));
  return "mumps";
}

/// For a solve that goes on from another: its own start is not to be pushed off the central path.
const IpoptSettings& warm_settings() {
  static const IpoptSettings settings = {{"warm_start_init_point", "yes"},
                                         {"warm_start_bound_push", "1e-9"},
                                         {"warm_start_bound_frac", "1e-9"},
                                         {"warm_start_mult_bound_push", "1e-12"}};
  return settings;
}

/// Factor on f that makes its largest derivative at the start `reach`.
///
/// One variable moves one voxel of perhaps 1e5, so f's derivatives are about 1e-5 while Ipopt's first barrier
/// parameter (0.1) and multipliers (1) take them to be about 1. Unscaled, the barrier drowns f for the first
/// iterations and the last barrier parameter leaves a gap of n * 1e-9 / 1e-5. Ipopt's own scaling only
/// shrinks.
/// The margin has no slope in x; the constraints that bound it have.
double natural_scale(const Task& task, const std::vector<double>& start, double reach) {
  const Moments s = task.total(start);
  std::vector<Moments> forms;
  if (task.problem.goal() == Goal::margin)
    for (const auto& row : task.problem.constraints().matrix.rowwise()) forms.emplace_back(row.transpose());
  else
    forms.push_back(task.problem.gradient(s));
  double largest = 0;
  const bool sizes_differ = task.formulation.refines();
  for (const Moments& form : forms) {
    std::vector<double> gradient(start.size());
    task.pull_back(start, {&form, 1}, gradient);
    for (double& g : gradient) g = std::abs(g);
    gradient.resize(start.size() - task.formulation.moving());  // what moves a body is scaled by its owner
    // Where cells differ in size by powers of two, so do their derivatives by powers of eight. What counts
    // are the many small ones.
    const auto counted = sizes_differ ? gradient.begin() + gradient.size() / 2 : gradient.end() - 1;
    std::ranges::nth_element(gradient, counted);
    largest = std::max(largest, *counted);
  }
  return largest > 0 ? reach / largest : 1.0;
}

template <class T>
bool parse_whole(const std::string& text, T& value) {
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return status == std::errc() && end == text.data() + text.size();
}

/// What Ipopt would say nothing of, or only that it refuses its options.
/// @throws InputError  an output that cannot be written
void require_usable(const IpoptSettings& given) {
  const auto file = given.find("output_file");
  if (file != given.end() && !file->second.empty() && !std::ofstream(file->second, std::ios::app))
    throw InputError(fmt::format(
        "ipopt.output_file = {} cannot be written; expected a file in a folder that is there", file->second));
}

/// @throws InputError  a value that the option does not take, or what is not there for it to take
void require_fit(const Ipopt::RegisteredOption& option, std::string_view key, std::string_view value) {
  const std::string text(value);
  int integer = 0;
  double number = 0;
  bool good = false;
  switch (option.Type()) {
    case Ipopt::OT_Integer:
      good = parse_whole(text, integer) && option.IsValidIntegerSetting(integer);
      break;
    case Ipopt::OT_Number:
      good = parse_whole(text, number) && option.IsValidNumberSetting(number);
      break;
    default:
      good = option.IsValidStringSetting(text);
  }
  if (option.Name() == "linear_solver" && text != "arrow" && text != "mumps")
    throw InputError(fmt::format("{} = {} is not installed; expected arrow or mumps", key, text));
  if (option.Name() == "option_file_name" && !text.empty())
    throw InputError(
        fmt::format("{} = {} is not read; expected each option as ipopt.NAME, so that the "
                    "record has them",
                    key, text));
  if (!good && text != "arrow")
    throw InputError(
        fmt::format("{} = {} is not a value Ipopt takes: {}", key, text, option.ShortDescription()));
}

}  // namespace

bool wants_exact_hessian(const Task& task, const SolverOptions& options) {
  const auto own = settings_as<IpoptSettings>(options.own);
  const auto asked = own.find("hessian_approximation");
  const bool moves = task.formulation.moving() > 0;
  if (asked == own.end()) return !moves;
  if (moves && asked->second == "exact")
    throw InputError(
        fmt::format("ipopt.hessian_approximation = exact with formulation '{}', which moves the body; "
                    "expected limited-memory: there are first derivatives alone",
                    task.formulation.name()));
  return asked->second == "exact";
}

bool goes_on(const SolverOptions& options) {
  return !options.from.empty() && !options.warm.multipliers.empty();
}

IpoptSettings ipopt_settings(const Task& task, const SolverOptions& options, Nlp& nlp,
                             const std::vector<double>& start) {
  const bool exact = wants_exact_hessian(task, options), linear = task.formulation.moments_are_linear();
  const auto own = settings_as<IpoptSettings>(options.own);
  require_usable(own);
  IpoptSettings settings = own;  // what the user gave stays, below
  settings.insert({"hessian_approximation", exact ? "exact" : "limited-memory"});
  if (options.untouched) {
    settings.insert({{"print_level", "0"}, {"sb", "yes"}, {"linear_solver", "mumps"}});
    return settings;
  }
  const std::string linear_solver = linear_solver_for(own, nlp, exact);
  settings["linear_solver"] = linear_solver;
  if (linear_solver == "mumps") settings.merge(defaults_of_mumps(task));
  // It looks at its residuals and refines by itself, so that Ipopt need not.
  if (linear_solver == "arrow") settings.insert({"fast_step_computation", "yes"});
  if (nlp.jacobian_is_constant()) settings.insert({{"jac_c_constant", "yes"}, {"jac_d_constant", "yes"}});
  Defaults defaults = defaults_for(linear, exact);
  settings.merge(defaults.settings);
  const double reach = options.reach.value_or(defaults.reach);
  settings.insert({"obj_scaling_factor", fmt::format("{:.6g}", natural_scale(task, start, reach))});
  if (goes_on(options)) settings.insert(warm_settings().begin(), warm_settings().end());
  return settings;
}

void set_ipopt_option(Ipopt::IpoptApplication& app, const std::string& name, const std::string& value) {
  int integer = 0;
  double number = 0;
  bool good = false;
  switch (app.RegOptions()->GetOption(name)->Type()) {
    case Ipopt::OT_Integer:
      good = parse_whole(value, integer) && app.Options()->SetIntegerValue(name, integer);
      break;
    case Ipopt::OT_Number:
      good = parse_whole(value, number) && app.Options()->SetNumericValue(name, number);
      break;
    default:
      good = app.Options()->SetStringValue(name, value);
  }
  if (!good) throw InputError(fmt::format("Ipopt refuses its option {} = {}", name, value));
}

SettingTable ipopt_options() {
  // They stay as long as the application, and the names in the table as long as they.
  static const Ipopt::SmartPtr<Ipopt::IpoptApplication> app = new Ipopt::IpoptApplication(false);
  Fields<IpoptSettings> fields;
  for (const auto& [name, entry] : app->RegOptions()->RegisteredOptionsList()) {
    const Ipopt::RegisteredOption* option = GetRawPtr(entry);
    fields.push_back({name, "", option->ShortDescription(),
                      [option](auto& settings, auto key, auto value) {
                        require_fit(*option, key, value);
                        settings[option->Name()] = value;
                      },
                      [option](auto& settings) {
                        const auto found = settings.find(option->Name());
                        return found == settings.end() ? std::string() : found->second;
                      }});
  }
  return fields;
}

}  // namespace kreisel::core
