#include "problem/problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "problem/spin.hpp"

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
  };
  return all;
}

std::unique_ptr<Problem> make_problem(std::string_view name, const ProblemSettings& settings) {
  std::string names;
  for (const ProblemEntry& entry : problems()) {
    if (entry.name == name) return entry.make(settings);
    names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.name);
  }
  throw InputError(fmt::format("problem '{}' is unknown; expected one of: {}", name, names));
}

}  // namespace kreisel
