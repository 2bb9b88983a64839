#include "problem/problem.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "error.hpp"
#include "problem/balance.hpp"
#include "problem/float.hpp"
#include "problem/spin.hpp"
#include "problem/stand.hpp"

namespace kreisel {

double violation(const Problem& problem, const Moments& s) {
  const LinearConstraints& c = problem.constraints();
  const Eigen::VectorXd value = c.matrix * s;
  return std::max({0.0, (c.lower - value).maxCoeff(), (value - c.upper).maxCoeff()});
}

const std::vector<ProblemEntry>& problems() {
  static const std::vector<ProblemEntry> all = {
      {"spin",
       "spins about its axis: centre of mass on it, principal, and the largest moment [RayRep, eq. 7-10]",
       make_spin},
      {"stand", "stands: centre of mass over the base and low, or the largest tilt before toppling",
       make_stand},
      {"float",
       "floats upright at a given draft: centre of mass over that of buoyancy, and low [RayRep, eq. 3-5]",
       make_float},
      {"balance", "centre of mass at a given point or on a given line, with as much material as possible",
       make_balance},
  };
  return all;
}

const ProblemEntry& find_problem(std::string_view name) {
  std::vector<std::string_view> names;
  for (const ProblemEntry& entry : problems()) {
    if (entry.name == name) return entry;
    names.push_back(entry.name);
  }
  throw InputError(fmt::format("problem '{}' is unknown; expected one of: {}", name, fmt::join(names, ", ")));
}

std::unique_ptr<Problem> make_problem(std::string_view name, const ProblemSettings& settings,
                                      const Body& body) {
  return find_problem(name).make(settings, body);
}

}  // namespace kreisel
