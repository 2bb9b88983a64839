#include "record/map_record.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "record/common_fields.hpp"
#include "record/schema.hpp"
#include "record/with_fields.hpp"

namespace kreisel::core {

static std::string_view to_string(Through through) {
  return through == Through::centre ? "centre" : "lowest";
}

namespace fields {

template <>
struct Names<Through> {
  static constexpr std::array all = {Through::lowest, Through::centre};
};

}  // namespace fields

namespace {
namespace of_map {

using namespace fields;
using nlohmann::json;

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

/// One number an axis and case, in the order of the answers.
template <class Of>
auto column(const OrientationMap& map, const Of& of) {
  std::vector<decltype(of(map.answers.front()))> values;
  for (const MapAnswer& answer : map.answers) values.push_back(of(answer));
  return values;
}

const char* units_of(const std::string& name) {
  return name.ends_with("_mm")        ? "mm"
         : name.ends_with("_mm2")     ? "mm^2"
         : name.ends_with("_mm3")     ? "mm^3"
         : name.ends_with("_degrees") ? "degrees"
         : name.ends_with("_rpm")     ? "1/min"
                                      : "1";
}

/// Apart from the rest: a problem chooses these names.
void write_values(hdf5::Group& group, const OrientationMap& map) {
  std::set<std::string> names;
  for (const MapAnswer& answer : map.answers)
    for (const auto& [name, value] : answer.verdict.values) names.insert(name);
  for (const std::string& name : names) {
    const auto value = [&](const MapAnswer& a) {
      const auto found = a.verdict.values.find(name);
      return found == a.verdict.values.end() ? nowhere : found->second;
    };
    group.write(name, column(map, value), {map.axes.size(), map.cases.size()}, {units_of(name), map.cases});
  }
}

void write_answers(hdf5::Group& file, const OrientationMap& map) {
  const hdf5::Shape shape{map.axes.size(), map.cases.size()};
  const auto status = [](const MapAnswer& a) {
    return a.status == MapAnswer::undecided ? -1 : a.status == MapAnswer::feasible ? 1 : 0;
  };
  file.write("feasible", column(map, status), shape, {"1", map.cases});
  file.write("ok", column(map, [](const MapAnswer& a) { return a.verdict.ok ? 1 : 0; }), shape,
             {"1", map.cases});
  file.write("objective", column(map, [](const MapAnswer& a) { return a.objective; }), shape,
             {"1", map.cases});
  file.write("loss", column(map, [](const MapAnswer& a) { return a.loss; }), shape, {"1", map.cases});
  file.write("miss", column(map, [](const MapAnswer& a) { return a.miss; }), shape,
             {"body units", map.cases});
}

void read_answers(const hdf5::Group& file, OrientationMap& map) {
  const auto feasible = file.read_integers("feasible"), ok = file.read_integers("ok");
  const auto objective = file.read("objective"), miss = file.read("miss");
  const std::size_t n = map.axes.size() * map.cases.size();
  if (feasible.shape.columns != map.cases.size() || ok.shape != feasible.shape ||
      feasible.values.size() != n || objective.values.size() != n || miss.values.size() != n)
    throw InputError("a map's record has " + std::to_string(feasible.shape.columns) +
                     " columns of answers, expected " + std::to_string(map.cases.size()) + ", one a case");
  map.answers.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int status = feasible.values[i];
    MapAnswer& answer = map.answers[i];
    answer.status = status < 0   ? MapAnswer::undecided
                    : status > 0 ? MapAnswer::feasible
                                 : MapAnswer::infeasible;
    answer.objective = answer.loss = objective.values[i];
    answer.miss = miss.values[i];
    answer.verdict.ok = ok.values[i] == 1;
  }
  if (file.contains("loss")) {
    const auto loss = file.read("loss").values;
    for (std::size_t i = 0; i < n; ++i) map.answers[i].loss = loss.at(i);
  } else if (file.integer("best_axis") >= 0) {  // early records say but which is the best
    map.answers[static_cast<std::size_t>(file.integer("best_axis")) * map.cases.size() +
                static_cast<std::size_t>(file.integer("best_case"))]
        .loss = -std::numeric_limits<double>::infinity();
  }
  if (!file.contains("values")) return;
  const hdf5::Group values = file.group("values");
  for (const std::string& name : values.children()) {
    const auto table = values.read(name);
    for (std::size_t i = 0; i < std::min(n, table.values.size()); ++i)
      map.answers[i].verdict.values[name] = table.values[i];
  }
}

json answer_json(const MapAnswer& answer) {
  constexpr const char* names[] = {"undecided", "feasible", "infeasible"};
  json all = {{"status", names[answer.status]},
              {"objective", answer.objective},
              {"miss", answer.miss},
              {"ok", answer.verdict.ok}};
  for (const auto& [name, value] : answer.verdict.values) all[name] = value;
  return all;
}

json draft_json(const OrientationMap& map, std::size_t c) {
  return map.cases[c].empty() ? json(nullptr) : json(map.cases[c]);
}

json best_json(const OrientationMap& map) {
  const auto place = map.best();
  if (!place) return nullptr;
  json best = answer_json(map.at(place->axis, place->at_case));
  best["axis"] = json_of(map.axes[place->axis]);
  best["contact"] = json_of(map.contacts[place->axis]);
  best["draft"] = draft_json(map, place->at_case);
  best["text"] = map.at(place->axis, place->at_case).verdict.text;
  best["command"] = map.command(*place);
  return best;
}

/// @param best  best_json()
json cases_json(const OrientationMap& map, const json& best) {
  json cases = json::array();
  const auto place = map.best();
  for (std::size_t c = 0; c < map.cases.size(); ++c)
    cases.push_back({{"draft", draft_json(map, c)},
                     {"feasible", map.count(c, MapAnswer::feasible)},
                     {"infeasible", map.count(c, MapAnswer::infeasible)},
                     {"undecided", map.count(c, MapAnswer::undecided)},
                     {"ok", map.count_ok(c)},
                     {"best", place && place->at_case == c ? best : json()}});
  return cases;
}

json axes_json(const OrientationMap& map) {
  json axes = json::array();
  for (std::size_t a = 0; a < map.axes.size(); ++a) {
    json answers = json::array();
    for (std::size_t c = 0; c < map.cases.size(); ++c) answers.push_back(answer_json(map.at(a, c)));
    axes.push_back(
        {{"axis", json_of(map.axes[a])}, {"contact", json_of(map.contacts[a])}, {"answers", answers}});
  }
  return axes;
}

constexpr auto vector_columns = [](auto& column, auto& v) { column.matrix({"x", "y", "z"}, v, ""); };

template <class F, class M>
void best_fields(F& f, M& map) {
  std::string text;
  if constexpr (!F::reading) {
    const auto best = map.best();
    f.stored("best_axis", best ? static_cast<int>(best->axis) : -1);
    f.stored("best_case", best ? static_cast<int>(best->at_case) : -1);
    f.stored("best_command", best ? map.command(*best) : "");
    if (best) text = map.at(best->axis, best->at_case).verdict.text;
  }
  f.late("best_text", "", text);
  if constexpr (F::reading)
    if (const auto best = map.best())
      map.answers[best->axis * map.cases.size() + best->at_case].verdict.text = text;
}

template <class F, class M>
void describe(F& f, M& map) {
  schema_fields(f, map_schema);
  config_fields(f, map.config);
  f.value("model", "model", map.body_name);
  f.value("problem", "problem", map.config.problem);
  f.given("formulation", map.config.formulation);
  f.given("solver", map.config.solver);
  f.value("cases", "", map.cases);
  if constexpr (F::reading)
    if (map.cases.empty()) map.cases.emplace_back();  // one case without a name
  f.value("through", "through", map.through);
  f.value("axes_asked", "axes_asked", map.asked);
  f.rows("axes", "", map.axes, "1", vector_columns);
  f.rows("contacts", "", map.contacts, "mm", vector_columns);
  f.stored("complete", map.axes.size() == map.asked);
  f.given("axes_answered", map.axes.size());
  f.given("termination", map.axes.size() == map.asked ? "complete" : "interrupted");
  f.value("setup_seconds", "seconds.setup", map.setup_seconds);
  f.value("sweep_seconds", "seconds.sweep", map.sweep_seconds);
  f.value("domain/kind", "domain", map.domain);
  f.value("domain/wall", "", map.wall, "L");
  f.value("domain/spacing", "", map.grid.h, "L");
  f.value("domain/rays", "rays", map.rays);
  f.value("domain/length", "", map.length_mm, "mm");
  f.value("domain/grid", "grid", map.grid.n, "cells");
  f.value("domain/frame_origin", "", map.frame.origin, "mm");
  f.value("domain/frame_rotation", "", map.frame.rotation, "1");
  f.bulk("", [&](hdf5::Group& file) { write_answers(file, map); });
  f.bulk("values", [&](hdf5::Group& values) { write_values(values, map); });
  if constexpr (F::reading) f.load("", [&](const hdf5::Group& file) { read_answers(file, map); });
  best_fields(f, map);
  provenance_fields(f, map.provenance);
}

}  // namespace of_map
}  // namespace

void write_map(const std::filesystem::path& path, const OrientationMap& map) {
  fields::write_with(path, [&](fields::ToHdf5& f) { of_map::describe(f, map); });
}

OrientationMap read_map(const std::filesystem::path& path) {
  OrientationMap map;
  fields::read_with(path, map_schema, [&](fields::FromHdf5& f) { of_map::describe(f, map); });
  return map;
}

nlohmann::json to_json(const OrientationMap& map) {
  return fields::json_with([&](fields::ToJson& f) {
    of_map::describe(f, map);
    const nlohmann::json best = of_map::best_json(map);
    f.given("best", best);
    f.given("cases", of_map::cases_json(map, best));
    f.given("axes", of_map::axes_json(map));
  });
}

}  // namespace kreisel::core
