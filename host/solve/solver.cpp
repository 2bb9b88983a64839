#include "solve/solver.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "error.hpp"
#include "solve/ipopt.hpp"

namespace kreisel {

std::string_view to_string(Termination termination) {
  switch (termination) {
    case Termination::optimal:
      return "optimal";
    case Termination::acceptable:
      return "acceptable";
    case Termination::infeasible:
      return "infeasible";
    case Termination::interrupted:
      return "interrupted";
    case Termination::failed:
      break;
  }
  return "failed";
}

SolverOptions parse_solver_options(const std::map<std::string, std::string>& settings) {
  SolverOptions options;
  for (const auto& [name, value] : settings) {
    if (name == "start")
      options.start = parse_start(value);
    else if (name == "curvature" && (value == "convex" || value == "full"))
      options.convexify = value == "convex";
    else if (name == "reach") {
      const auto [end, status] =
          std::from_chars(value.data(), value.data() + value.size(), options.reach.emplace());
      if (status != std::errc() || end != value.data() + value.size() || !(*options.reach > 0))
        throw InputError(fmt::format("solver.reach = {}; expected a number > 0", value));
    } else
      throw InputError(fmt::format(
          "solver.{} = {}; expected start = lower, middle or upper, curvature = convex or full, or reach = "
          "NUMBER",
          name, value));
  }
  return options;
}

const std::vector<SolverEntry>& solvers() {
  static const std::vector<SolverEntry> all = {
      {"ipopt",
       "interior point: lifted exact Hessian, or L-BFGS (ipopt.hessian_approximation=limited-memory)",
       solve_with_ipopt,
       {"voxel", "rayrep"}},
  };
  return all;
}

const SolverEntry& find_solver(std::string_view name, std::string_view formulation) {
  std::vector<std::string_view> names;
  for (const SolverEntry& entry : solvers()) {
    if (entry.name == name) {
      if (std::ranges::find(entry.formulations, formulation) == entry.formulations.end())
        throw InputError(fmt::format("solver '{}' does not work with formulation '{}'; it works with: {}",
                                     name, formulation, fmt::join(entry.formulations, ", ")));
      return entry;
    }
    names.push_back(entry.name);
  }
  throw InputError(fmt::format("solver '{}' is unknown; expected one of: {}", name, fmt::join(names, ", ")));
}

}  // namespace kreisel
