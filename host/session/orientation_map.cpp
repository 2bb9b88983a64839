#include "session/orientation_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "error.hpp"
#include "geometry/rotation.hpp"
#include "problem/turned.hpp"
#include "solve/distance_to_rows.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A step through n things in a circle that visits all, so that any number of steps spreads evenly.
std::size_t even_step(std::size_t n) {
  auto step = static_cast<std::size_t>(static_cast<double>(n) / std::numbers::phi);
  while (step > 1 && std::gcd(step, n) != 1) --step;
  return std::max<std::size_t>(step, 1);
}

/// What all axes share.
struct Sweep {
  const SolverEntry& solver;
  SolverOptions options;
  Formulation& formulation;
  const MassModel& mass;
  device::Device& device;
  double length_mm;
  const Control& control;

  /// @return  nothing when the user stopped it
  [[nodiscard]] std::optional<MapAnswer> answer(const Problem& problem) const {
    const Task task{problem, formulation, mass, device, control.stop};
    const Outcome outcome = solve(solver, task, options);
    MapAnswer result;
    result.objective = result.miss = nan;
    switch (outcome.termination) {
      case Termination::interrupted:
        return std::nullopt;
      case Termination::optimal:
      case Termination::acceptable:
        result.status = MapAnswer::feasible;
        result.objective = outcome.objective;
        result.miss = 0;
        result.verdict = problem.verify(outcome.moments, length_mm);
        return result;
      case Termination::infeasible:
      case Termination::failed:
        break;
    }
    const RowDistance distance =
        distance_to_rows(*formulation.oracle(), mass, problem.constraints(), 1e-3, 1e-7, control.stop);
    // Below this nobody could tell; a solver that gave up may have had only its own difficulties.
    constexpr double least = 1e-6;
    if (outcome.termination == Termination::infeasible || distance.proved > least)
      result.status = MapAnswer::infeasible;
    result.miss = distance.attained;
    if (control.stopped()) return std::nullopt;  // it stopped early
    return result;
  }
};

Vec3 contact_of(const Body& body, const Vec3& axis, Through through) {
  const Vec3 lowest = lowest_point(body.mesh, axis);
  if (through == Through::lowest) return lowest;
  const Vec3 centre = body.frame.to_model(centre_of_mass(body.solid)), up = axis.normalized();
  return centre - up.dot(centre - lowest) * up;
}

std::vector<std::string> cases_of(const MapSpec& spec, const MapCases& cases) {
  if (!cases.setting.empty()) {
    if (spec.drafts.empty())
      throw InputError(fmt::format("a map of {} without {}s; expected one or more, such as {}",
                                   spec.config.problem, cases.setting, cases.usual));
    return spec.drafts;
  }
  if (!spec.drafts.empty())
    throw InputError(fmt::format("drafts for {}; expected --problem float", spec.config.problem));
  return {""};
}

/// Fields and settings as one writes them on the command line.
std::string quoted(const std::string& text) {
  if (text.find_first_of(" \t'\"\\$`&|;<>()*?[]#~!{}") == std::string::npos) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

MapSpec map_spec(const MapRun& map) {
  MapSpec spec{map, sphere_directions(map.axes), map.drafts, map.through};
  const std::optional<MapCases>& cases = find_problem(map.problem).map;
  if (cases && spec.drafts.empty()) spec.drafts = cases->values;
  return spec;
}

std::size_t OrientationMap::count(std::size_t at_case, MapAnswer::Status status) const {
  std::size_t n = 0;
  for (std::size_t a = 0; a < axes.size(); ++a) n += at(a, at_case).status == status;
  return n;
}

std::size_t OrientationMap::count_ok(std::size_t at_case) const {
  std::size_t n = 0;
  for (std::size_t a = 0; a < axes.size(); ++a) n += at(a, at_case).verdict.ok;
  return n;
}

std::optional<OrientationMap::Place> OrientationMap::best() const {
  const std::string most = find_problem(config.problem).map.value_or(MapCases{}).most;
  const auto loss = [&](const MapAnswer& answer) {
    return most.empty() ? answer.objective : -answer.verdict.values.at(most);
  };
  std::optional<Place> best;
  for (std::size_t a = 0; a < axes.size(); ++a)
    for (std::size_t c = 0; c < cases.size(); ++c) {
      const MapAnswer& here = at(a, c);
      if (here.status != MapAnswer::feasible) continue;
      if (best) {
        const MapAnswer& so_far = at(best->axis, best->at_case);
        if (here.verdict.ok < so_far.verdict.ok) continue;
        if (here.verdict.ok == so_far.verdict.ok && !(loss(here) < loss(so_far))) continue;
      }
      best = Place{a, c};
    }
  return best;
}

std::string OrientationMap::command(Place place) const {
  RunConfig run;
  static_cast<Asked&>(run) = config;
  const ProblemEntry& problem = find_problem(run.problem);
  const bool upright = problem.upright;
  run.body.axis = run.body.up = run.body.contact = std::nullopt;
  if (!cases[place.at_case].empty()) run.settings["problem." + problem.map->setting] = cases[place.at_case];
  std::string line = "bench";
  for (const auto& [key, value] : describe(run))
    line += key.find('.') != std::string::npos ? fmt::format(" --set {}", quoted(key + "=" + value))
                                               : fmt::format(" --{} {}", key, quoted(value));
  return line + fmt::format(" --{}={:.9g} --contact={:.9g}", upright ? "up" : "axis",
                            fmt::join(axes[place.axis], ","), fmt::join(contacts[place.axis], ","));
}

namespace {

/// @throws InputError  a problem that has no map, no axes, one without a direction
const ProblemEntry& checked_problem(const MapSpec& spec) {
  const ProblemEntry& asked = find_problem(spec.config.problem);
  if (!asked.map) {
    std::vector<std::string_view> mapped;
    for (const ProblemEntry& other : problems())
      if (other.map) mapped.push_back(other.name);
    throw InputError(
        fmt::format("a map of {}; expected the problem {}", asked.name, fmt::join(mapped, " or ")));
  }
  if (spec.axes.empty()) throw InputError("a map without axes; expected one or more");
  for (const Vec3& axis : spec.axes)
    if (!axis.allFinite() || axis.norm() == 0)
      throw InputError(
          fmt::format("axis {} has no direction; expected a non-zero vector", fmt::join(axis, ",")));
  return asked;
}

/// What a map says of itself beside its answers.
void describe(OrientationMap& map, const Stages& stages, const Provenance& provenance) {
  const Body& body = *stages.body;
  const RunDomain& domain = *stages.domain;

  map.provenance = provenance;
  map.body_name = body.name;
  map.length_mm = body.frame.length;
  map.mass_unit_grams = body.mass_grams();
  map.frame = body.frame;
  map.domain = domain.kind();
  map.grid = domain.grid();
  map.wall = domain.wall();
  map.rays = domain.rays().columns.size();
}

}  // namespace

OrientationMap map_orientations(Session& session, const MapSpec& spec, const Control& control) {
  const Stopwatch setup;
  const ProblemEntry& asked = checked_problem(spec);
  OrientationMap map;
  map.config = spec.config;
  map.cases = cases_of(spec, *asked.map);
  map.through = spec.through;
  map.asked = spec.axes.size();
  const SolverEntry& solver = find_solver(map.config.solver, map.config.formulation);
  SolverOptions options = parse_solver_options(settings_of(map.config, "solver"));
  // A hundred-thousandth of what a verdict asks for. The last digits would cost most of the time, near
  // directions across the rays above all, where a plane turns whole rays on and off.
  options.own = {{"tolerance", "1e-8"}};
  for (const auto& [name, value] : settings_of(map.config, map.config.solver)) options.own[name] = value;
  const Stages stages = session.stages(map.config, control);
  describe(map, stages, session.provenance());
  map.setup_seconds = setup.seconds();
  const Body& body = *stages.body;

  const Stopwatch sweeping;
  const Sweep sweep{solver, options, *stages.formulation, stages.mass, *stages.device, body.frame.length,
                    control};
  const std::size_t n = spec.axes.size(), step = even_step(n);
  std::vector<std::vector<MapAnswer>> answers(n);  // empty: not done
  std::vector<Vec3> contacts(n);
  ProblemSettings settings = settings_of(map.config, "problem");
  Body turned = body;
  Stopwatch told;
  for (std::size_t k = 0; k < n && !control.stopped(); ++k) {
    if (k == 0 || told.seconds() > 0.1) {
      control.tell(fmt::format("axis {} of {}", k + 1, n));
      told = {};
    }
    const std::size_t i = k * step % n;
    contacts[i] = contact_of(body, spec.axes[i], spec.through);
    reframe(turned, body, spec.axes[i], contacts[i]);
    const Eigen::Matrix3d R = turned.frame.rotation * body.frame.rotation.transpose();
    const Vec3 t = turned.frame.to_body(body.frame.origin);
    std::vector<MapAnswer> here;
    for (const std::string& at_case : map.cases) {
      if (!at_case.empty()) settings[asked.map->setting] = at_case;
      const Turned problem(asked.make(settings, turned), R, t);
      std::optional<MapAnswer> answer = sweep.answer(problem);
      if (!answer) break;
      here.push_back(std::move(*answer));
    }
    if (here.size() == map.cases.size()) answers[i] = std::move(here);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (answers[i].empty()) continue;
    map.axes.push_back(spec.axes[i].normalized());
    map.contacts.push_back(contacts[i]);
    std::ranges::move(answers[i], std::back_inserter(map.answers));
  }
  map.sweep_seconds = sweeping.seconds();
  return map;
}

}  // namespace kreisel::core
