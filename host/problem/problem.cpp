#include "problem/problem.hpp"

#include <algorithm>

#include "problem/balance.hpp"
#include "problem/die.hpp"
#include "problem/float.hpp"
#include "problem/hang.hpp"
#include "problem/ray_direction.hpp"
#include "problem/spin.hpp"
#include "problem/stand.hpp"
#include "problem/top.hpp"
#include "problem/yoyo.hpp"

namespace kreisel::core {

double violation(const Problem& problem, const Moments& s) {
  double most = 0;
  const auto look_at = [&](const Eigen::VectorXd& value, const auto& lower, const auto& upper) {
    if (value.size() > 0) most = std::max({most, (lower - value).maxCoeff(), (value - upper).maxCoeff()});
  };
  const LinearConstraints& c = problem.constraints();
  look_at(c.matrix * s, c.lower, c.upper);
  const Nonlinear* more = problem.nonlinear();
  if (more && more->variables() == 0) look_at(more->rows(s, {}), more->lower(), more->upper());
  return most;
}

namespace {

std::vector<ProblemEntry> ours() {
  return {
      {"spin",
       "spins about its axis: centre of mass on it, principal, and the largest moment [RayRep, eq. 7-10]",
       make_spin,
       ProblemSettings{},
       false,
       {"lambda", "gamma_i"},
       {{"lambda", "0"}, {"gamma_i", "1"}},
       false,
       {},
       Poses::any},
      {"top",
       "spins on its tip: as spin, with centre of mass and mass lowered, or the height alone [SpinIt, "
       "eq. 3]",
       make_top,
       std::nullopt,
       false,
       {"lower", "gamma_c", "gamma_i", "form"},
       {{"lower", "mass"}, {"gamma_c", "1"}, {"gamma_i", "1"}, {"form", "trace"}},
       false,
       {},
       Poses::any},
      {"yoyo",
       "spins about its axle: centre of mass at the axle's centre, principal, and the largest moment "
       "[SpinIt, eq. 2]",
       make_yoyo,
       std::nullopt,
       false,
       {"gamma_i", "form"},
       {{"gamma_i", "1"}, {"form", "trace"}},
       true,
       {},
       Poses::any},
      {"stand",
       "stands: centre of mass over the base and low, or the largest tilt before toppling",
       make_stand,
       ProblemSettings{},
       true,
       {"target", "margin", "base"},
       {},
       false,
       {},
       Poses::rest},
      {"float",
       "floats upright at a given draft: centre of mass over that of buoyancy, and low [RayRep, eq. 3-5]",
       make_float,
       ProblemSettings{{"draft", "solid"}},
       true,
       {"draft", "fluid_density"},
       {},
       false,
       {},
       Poses::any,
       drafts_of},
      {"balance",
       "centre of mass at a given point or on a given line, with as much material as possible",
       make_balance,
       std::nullopt,
       true,
       {"point", "line"},
       {},
       false,
       rays_of_balance},
      {"hang",
       "hung from a point, it hangs as it lies: centre of mass straight below, with as much material as "
       "possible",
       make_hang,
       std::nullopt,
       true,
       {"point", "line"},
       {},
       false,
       rays_of_hang},
      {"die",
       "a fair die: its faces come up as alike as its shape allows, with as much material as possible",
       make_die,
       std::nullopt,
       true,
       {},
       {},
       false,
       rays_of_die},
  };
}

}  // namespace

Registry<ProblemEntry>& problems() {
  static Registry<ProblemEntry> all("problem", ours());
  return all;
}

const ProblemEntry& find_problem(std::string_view name) { return problems().find(name); }

std::unique_ptr<Problem> make_problem(std::string_view name, const ProblemSettings& settings,
                                      const Body& body) {
  return find_problem(name).make(settings, body);
}

}  // namespace kreisel::core
