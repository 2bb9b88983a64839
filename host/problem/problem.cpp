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

Misses misses_axis(const Values& values, const Settings&) {
  return {value_of(values, "off_axis_mm"), value_of(values, "tilt_degrees")};
}

Misses misses_axle(const Values& values, const Settings&) {
  return {std::hypot(value_of(values, "off_axis_mm"), value_of(values, "centre_of_mass_z_mm")),
          value_of(values, "tilt_degrees")};
}

/// Of what is to stand anywhere inside its base: how far outside of it.
Misses misses_base(const Values& values, const Settings& settings) {
  const bool over_centre = settings_as<StandSettings>(settings).target == StandTarget::centre;
  return {over_centre ? value_of(values, "off_centroid_mm") : std::max(0.0, -value_of(values, "inside_mm"))};
}

Misses misses_buoyancy(const Values& values, const Settings&) {
  return {value_of(values, "offset_mm"), Misses::none, value_of(values, "excess_mass")};
}

Misses misses_point(const Values& values, const Settings&) { return {value_of(values, "offset_mm")}; }

using Names = std::vector<std::string_view>;

std::vector<ProblemEntry> ours() {
  return {
      {.name = "spin",
       .summary =
           "spins about its axis: centre of mass on it, principal, and the largest moment [RayRep, eq. 7-10]",
       .make = make_spin,
       .for_solid = SettingTexts{},
       .by_moments = true,
       .settings = spin_fields(),
       .weights = {"lambda", "gamma_i"},
       .made = {"a spinning top: it spins about the axis", {}, Names{"axis", "contact", "stem", "tip"}},
       .moves = Moves::spins,
       .map = MapCases{},
       .misses = misses_axis,
       .poses = Poses::any},
      {.name = "top",
       .summary = "spins on its tip: as spin, with centre of mass and mass lowered, or the height alone "
                  "[SpinIt, eq. 3]",
       .make = make_top,
       .by_moments = true,
       .settings = top_fields(),
       .weights = {"lower", "gamma_c", "gamma_i", "form"},
       .made = {"a spinning top whose centre of mass is low: it spins slowly, too",
                {},
                Names{"axis", "contact", "stem", "tip"}},
       .verb = "spin",
       .moves = Moves::spins,
       .misses = misses_axis,
       .poses = Poses::any},
      {.name = "yoyo",
       .summary = "spins about its axle: centre of mass at the axle's centre, principal, and the largest "
                  "moment [SpinIt, eq. 2]",
       .make = make_yoyo,
       .settings = yoyo_fields(),
       .weights = {"gamma_i", "form"},
       .centred = true,
       .made = {"a yo-yo: it spins about its axle",
                {},
                Names{"axis", "contact", "axle", "slot", "axle-depth"}},
       .verb = "spin",
       .moves = Moves::spins,
       .misses = misses_axle,
       .poses = Poses::any},
      {.name = "stand",
       .summary = "stands: centre of mass over the base and low, or the largest tilt before toppling",
       .make = make_stand,
       .for_solid = SettingTexts{},
       .upright = true,
       .settings = stand_fields(),
       .made = {"it stands on what is lowest", {{"target", "max-tilt"}}, Names{"up", "flatten"}},
       .moves = Moves::topples,
       .misses = misses_base,
       .poses = Poses::rest},
      {.name = "float",
       .summary =
           "floats upright at a given draft: centre of mass over that of buoyancy, and low [RayRep, eq. 3-5]",
       .make = make_float,
       .for_solid = SettingTexts{{"draft", "solid"}},
       .upright = true,
       .settings = float_fields(),
       .made = {.help = "it floats upright at a given draft"},
       .moves = Moves::heels,
       .map = MapCases{"draft", {"20%", "40%", "60%", "80%"}, "60%"},
       .misses = misses_buoyancy,
       .poses = Poses::any,
       .chosen = "draft",
       .choices = drafts_of},
      {.name = "balance",
       .summary = "centre of mass at a given point or on a given line, with as much material as possible",
       .make = make_balance,
       .by_moments = true,
       .upright = true,
       .settings = balance_fields(),
       .rays = rays_of_balance,
       .made = {.help = "its centre of mass is at a point, or on a line"},
       .misses = misses_point},
      {.name = "hang",
       .summary =
           "hung from a point, it hangs as it lies: centre of mass straight below, with as much material "
           "as possible",
       .make = make_hang,
       .upright = true,
       .settings = hang_fields(),
       .rays = rays_of_hang,
       .made = {.help = "hung from a point it keeps its pose", .shape = Names()},
       .misses = misses_point},
      {.name = "die",
       .summary =
           "a fair die: its faces come up as alike as its shape allows, with as much material as possible",
       .make = make_die,
       .upright = true,
       .rays = rays_of_die,
       .made = {.help = "a fair die: its faces come up alike", .shape = Names()},
       .verb = "be a fair die"},
  };
}

}  // namespace

SettingTexts ProblemEntry::usual_weights() const {
  SettingTexts all = settings.in_force(read({}));
  std::erase_if(all,
                [&](const auto& entry) { return std::ranges::find(weights, entry.first) == weights.end(); });
  return all;
}

Registry<ProblemEntry>& problems() {
  static Registry<ProblemEntry> all("problem", ours());
  return all;
}

const ProblemEntry& find_problem(std::string_view name) { return problems().find(name); }

std::unique_ptr<Problem> make_problem(std::string_view name, const SettingTexts& settings, const Body& body) {
  const ProblemEntry& entry = find_problem(name);
  return entry.make(entry.read(settings), body);
}

}  // namespace kreisel::core
