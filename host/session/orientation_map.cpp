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
#include "session/sweep.hpp"
#include "stopwatch.hpp"
#include "words.hpp"

namespace kreisel::core {
namespace {

/// A step through n things in a circle that visits all, so that any number of steps spreads evenly.
std::size_t even_step(std::size_t n) {
  auto step = static_cast<std::size_t>(static_cast<double>(n) / std::numbers::phi);
  while (step > 1 && std::gcd(step, n) != 1) --step;
  return std::max<std::size_t>(step, 1);
}

std::vector<std::string> cases_of(const MapSpec& spec, const MapCases& cases) {
  if (!cases.setting.empty()) {
    if (spec.drafts.empty())
      throw InputError(fmt::format("a map of {} without {}s; expected one or more, such as {}",
                                   spec.config.problem, cases.setting, cases.usual));
    return spec.drafts;
  }
  if (!spec.drafts.empty())
    throw InputError(fmt::format("drafts for the problem {}; expected --problem float", spec.config.problem));
  return {""};
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
  std::optional<Place> best;
  for (std::size_t a = 0; a < axes.size(); ++a)
    for (std::size_t c = 0; c < cases.size(); ++c) {
      const MapAnswer& here = at(a, c);
      if (here.status != MapAnswer::feasible) continue;
      if (best) {
        const MapAnswer& so_far = at(best->axis, best->at_case);
        if (here.verdict.ok < so_far.verdict.ok) continue;
        if (here.verdict.ok == so_far.verdict.ok && !(here.loss < so_far.loss)) continue;
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
    line += key.find('.') != std::string::npos ? fmt::format(" --set {}", shell_word(key + "=" + value))
                                               : fmt::format(" --{} {}", key, shell_word(value));
  return line + fmt::format(" --{}={:.9g} --contact={:.9g}", upright ? "up" : "axis",
                            fmt::join(axes[place.axis], ","), fmt::join(contacts[place.axis], ","));
}

namespace {

/// @throws InputError  a problem that has no map, no axes, one without a direction
const ProblemEntry& checked_problem(const MapSpec& spec) {
  const ProblemEntry& asked = find_problem(spec.config.problem);
  if (asked.poses != Poses::any) {
    std::vector<std::string_view> mapped;
    for (const ProblemEntry& other : problems())
      if (other.poses == Poses::any) mapped.push_back(other.name);
    throw InputError(
        fmt::format("a map of the problem {}; expected one that can be asked for any direction: {}",
                    asked.name, fmt::join(mapped, ", ")));
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
  const MapCases cases = asked.map.value_or(MapCases{});
  map.cases = cases_of(spec, cases);
  map.through = spec.through;
  map.asked = spec.axes.size();
  const Stages stages = session.stages(map.config, control);
  describe(map, stages, session.provenance());
  map.setup_seconds = setup.seconds();
  const Body& body = *stages.body;

  const Stopwatch sweeping;
  Sweep sweep(stages, map.config, control);
  const std::size_t n = spec.axes.size(), step = even_step(n);
  std::vector<std::vector<MapAnswer>> answers(n);  // empty: not done
  std::vector<Vec3> contacts(n);
  std::vector<Settings> settings;  // of each case
  for (const std::string& at_case : map.cases) {
    SettingTexts texts = settings_of(map.config, "problem");
    if (!at_case.empty()) texts[cases.setting] = at_case;
    settings.push_back(asked.read(texts));
  }
  Stopwatch told;
  for (std::size_t k = 0; k < n && !control.stopped(); ++k) {
    if (k == 0 || told.seconds() > 0.1) {
      control.tell(fmt::format("axis {} of {}", k + 1, n));
      told = {};
    }
    const std::size_t i = k * step % n;
    contacts[i] = asked.centred ? body.frame.to_model(centre_of_mass(body.solid))
                                : contact_of(body, spec.axes[i], spec.through);
    sweep.turn(spec.axes[i], contacts[i]);
    std::vector<MapAnswer> here;
    for (const Settings& at_case : settings) {
      std::optional<MapAnswer> answer = sweep.answer(at_case);
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
