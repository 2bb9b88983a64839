#include "session/map_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "error.hpp"
#include "problem/problem.hpp"
#include "settings/field_text.hpp"
#include "solve/solver.hpp"

namespace kreisel::core {
using namespace field_text;
namespace {

using M = MapRun&;
using ConstM = const MapRun&;
using S = std::string_view;

/// Whether a problem that can be mapped has this setting, and no case of the map says it.
bool can_be_mapped_with(S setting) {
  return std::ranges::any_of(problems(), [&](const ProblemEntry& problem) {
    return problem.map && problem.map->setting != setting && find_field(problem.settings.fields(), setting);
  });
}

/// Of what is asked, all but what is for problems that have no map, and what each case of a map says anew.
Fields<MapRun> asked_of_map() {
  constexpr std::array<S, 7> of_a_part = {"axis-through", "stem", "tip",       "flatten",
                                          "axle",         "slot", "axle-depth"};
  Fields<MapRun> fields;
  for (const Field<MapRun>& field : joined<MapRun>(asked_fields()))
    if (std::ranges::find(of_a_part, field.name) == of_a_part.end() &&
        (!is_setting(field.name) || can_be_mapped_with(field.name.substr(field.name.find('.') + 1))))
      fields.push_back(field);
  for (Field<MapRun>& field : fields) {
    if (field.name == "domain") field.identity = Identity::none;  // said as solves say it: describe()
    if (field.name == "formulation")
      field.set = [](M m, S, S v) {
        try {
          (void)find_solver(map_solver, v);
        } catch (const InputError& error) {
          throw InputError(fmt::format("{}; expected one that a map can be made with", error.what()));
        }
        m.formulation = v;
      };
    if (field.name == "solver")
      field.set = [](M, S k, S v) {
        if (v != map_solver) refuse(k, v, map_solver);
      };
  }
  return fields;
}

Fields<MapRun> orientation_fields() {
  return grouped<MapRun>(
      "orientations",
      {{"axes", "", "how many directions of the sphere to try; default 2000",
        [](M m, S k, S v) { m.axes = whole(k, v, 1); }, [](ConstM m) { return std::to_string(m.axes); },
        Identity::always},
       one_of<MapRun>(
           "through",
           "where the axes run: through the lowest point (lowest, default) or the solid's centre of mass "
           "(centre)",
           ways_through, [](auto& m) -> auto& { return m.through; }, Identity::always),
       {"drafts", "", "float: depths to try, in per cent of the height, mm or grams; default 20%,40%,60%,80%",
        [](M m, S, S v) {
          const auto parts = split(v, ',');
          m.drafts = {parts.begin(), parts.end()};
        },
        [](ConstM m) { return fmt::format("{}", fmt::join(m.drafts, ",")); }}});
}

}  // namespace

MapRun::MapRun() {
  formulation = "quadric";
  solver = map_solver;
}

MapRun::MapRun(Asked asked) : Asked(std::move(asked)) {
  (void)find_solver(map_solver, formulation);
  solver = map_solver;
}

const Fields<MapRun>& map_fields() {
  static const Fields<MapRun> all = joined<MapRun>(asked_of_map(), orientation_fields());
  return all;
}

void set_field(MapRun& map, std::string_view key, std::string_view value) {
  if (key.find('.') != std::string_view::npos)
    set_setting(map, key, value);
  else
    set_field(map_fields(), map, key, value);
}

std::map<std::string, std::string> describe(const MapRun& map) {
  auto said = describe(map_fields(), map, MapRun());
  said.insert(map.settings.begin(), map.settings.end());
  if (const std::string domain = domain_of(map); domain != "columns") said["domain"] = domain;
  return said;
}

std::string run_name(const MapRun& map) { return run_name(map, describe(map), "map"); }

}  // namespace kreisel::core
