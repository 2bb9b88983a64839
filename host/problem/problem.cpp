#include "problem/problem.hpp"

#include <algorithm>
#include <cmath>

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

using Values = std::map<std::string, double>;

double value_of(const Values& values, const char* name) {
  const auto entry = values.find(name);
  return entry == values.end() ? Misses::none : entry->second;
}

Misses misses_axis(const Values& values, const ProblemSettings&) {
  return {value_of(values, "off_axis_mm"), value_of(values, "tilt_degrees")};
}

Misses misses_axle(const Values& values, const ProblemSettings&) {
  return {std::hypot(value_of(values, "off_axis_mm"), value_of(values, "centre_of_mass_z_mm")),
          value_of(values, "tilt_degrees")};
}

/// Of what is to stand anywhere inside its base: how far outside of it.
Misses misses_base(const Values& values, const ProblemSettings& settings) {
  const auto target = settings.find("target");
  const bool over_centre = target == settings.end() || target->second == "centre";
  return {over_centre ? value_of(values, "off_centroid_mm") : std::max(0.0, -value_of(values, "inside_mm"))};
}

Misses misses_buoyancy(const Values& values, const ProblemSettings&) {
  return {value_of(values, "offset_mm"), Misses::none, value_of(values, "excess_mass")};
}

Misses misses_point(const Values& values, const ProblemSettings&) { return {value_of(values, "offset_mm")}; }

std::vector<ProblemEntry> ours() {
  return {
      {.name = "spin",
       .summary =
           "spins about its axis: centre of mass on it, principal, and the largest moment [RayRep, eq. 7-10]",
       .make = make_spin,
       .for_solid = ProblemSettings{},
       .settings = {"lambda", "gamma_i"},
       .weights = {{"lambda", "0"}, {"gamma_i", "1"}},
       .moves = Moves::spins,
       .map = MapCases{},
       .misses = misses_axis,
       .poses = Poses::any},
      {.name = "top",
       .summary = "spins on its tip: as spin, with centre of mass and mass lowered, or the height alone "
                  "[SpinIt, eq. 3]",
       .make = make_top,
       .settings = {"lower", "gamma_c", "gamma_i", "form"},
       .weights = {{"lower", "mass"}, {"gamma_c", "1"}, {"gamma_i", "1"}, {"form", "trace"}},
       .verb = "spin",
       .moves = Moves::spins,
       .misses = misses_axis,
       .poses = Poses::any},
      {.name = "yoyo",
       .summary = "spins about its axle: centre of mass at the axle's centre, principal, and the largest "
                  "moment [SpinIt, eq. 2]",
       .make = make_yoyo,
       .settings = {"gamma_i", "form"},
       .weights = {{"gamma_i", "1"}, {"form", "trace"}},
       .centred = true,
       .verb = "spin",
       .moves = Moves::spins,
       .misses = misses_axle,
       .poses = Poses::any},
      {.name = "stand",
       .summary = "stands: centre of mass over the base and low, or the largest tilt before toppling",
       .make = make_stand,
       .for_solid = ProblemSettings{},
       .upright = true,
       .settings = {"target", "margin", "base"},
       .moves = Moves::topples,
       .misses = misses_base,
       .poses = Poses::rest},
      {.name = "float",
       .summary =
           "floats upright at a given draft: centre of mass over that of buoyancy, and low [RayRep, eq. 3-5]",
       .make = make_float,
       .for_solid = ProblemSettings{{"draft", "solid"}},
       .upright = true,
       .settings = {"draft", "fluid_density"},
       .moves = Moves::heels,
       .map = MapCases{"draft", {"20%", "40%", "60%", "80%"}, "60%"},
       .misses = misses_buoyancy,
       .poses = Poses::any,
       .choices = drafts_of},
      {.name = "balance",
       .summary = "centre of mass at a given point or on a given line, with as much material as possible",
       .make = make_balance,
       .upright = true,
       .settings = {"point", "line"},
       .rays = rays_of_balance,
       .misses = misses_point},
      {.name = "hang",
       .summary =
           "hung from a point, it hangs as it lies: centre of mass straight below, with as much material "
           "as possible",
       .make = make_hang,
       .upright = true,
       .settings = {"point", "line"},
       .rays = rays_of_hang,
       .misses = misses_point},
      {.name = "die",
       .summary =
           "a fair die: its faces come up as alike as its shape allows, with as much material as possible",
       .make = make_die,
       .upright = true,
       .rays = rays_of_die,
       .verb = "be a fair die"},
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
