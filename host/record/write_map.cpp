#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "json_list.hpp"
#include "record/common_groups.hpp"
#include "record/hdf5_file.hpp"
#include "record/map_record.hpp"

namespace kreisel::core {
namespace {

using hdf5::Group;
using nlohmann::json;

void write_vectors(Group& group, const std::string& name, const std::vector<Vec3>& vectors,
                   const char* units) {
  std::vector<double> values;
  for (const Vec3& v : vectors) values.insert(values.end(), {v[0], v[1], v[2]});
  group.write(name, values, {vectors.size(), 3}, {units, {"x", "y", "z"}});
}

/// One number an axis and case, in the order of the answers.
template <class Of>
auto column(const OrientationMap& map, const Of& of) {
  std::vector<decltype(of(map.answers.front()))> values;
  for (const MapAnswer& answer : map.answers) values.push_back(of(answer));
  return values;
}

/// Names of all numbers behind the verdicts.
std::set<std::string> value_names(const OrientationMap& map) {
  std::set<std::string> names;
  for (const MapAnswer& answer : map.answers)
    for (const auto& [name, value] : answer.verdict.values) names.insert(name);
  return names;
}

double value_of(const MapAnswer& answer, const std::string& name) {
  const auto found = answer.verdict.values.find(name);
  return found == answer.verdict.values.end() ? nan : found->second;
}

const char* units_of(const std::string& name) {
  return name.ends_with("_mm")        ? "mm"
         : name.ends_with("_mm2")     ? "mm^2"
         : name.ends_with("_mm3")     ? "mm^3"
         : name.ends_with("_degrees") ? "degrees"
         : name.ends_with("_rpm")     ? "1/min"
                                      : "1";
}

void write_values(Group group, const OrientationMap& map) {
  for (const std::string& name : value_names(map))
    group.write(name, column(map, [&](const MapAnswer& a) { return value_of(a, name); }),
                {map.axes.size(), map.cases.size()}, {units_of(name), map.cases});
}

void write_domain(Group group, const OrientationMap& map) {
  group.set("kind", map.domain);
  group.set("wall", map.wall);
  group.set("wall_units", "L");
  group.set("spacing", map.grid.h);
  group.set("spacing_units", "L");
  group.set("rays", map.rays);
  group.set("length", map.length_mm);
  group.set("length_units", "mm");
  group.write("grid", map.grid.n, {3}, {"cells", {"x", "y", "z"}});
  group.write("frame_origin", {map.frame.origin.data(), 3}, {3}, {"mm", {"x", "y", "z"}});
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = map.frame.rotation;
  group.write("frame_rotation", {rotation.data(), 9}, {3, 3}, {"1", {"x", "y", "z"}});
}

json to_json(const MapAnswer& answer) {
  constexpr const char* names[] = {"undecided", "feasible", "infeasible"};
  json all = {{"status", names[answer.status]},
              {"objective", answer.objective},
              {"miss", answer.miss},
              {"ok", answer.verdict.ok}};
  for (const auto& [name, value] : answer.verdict.values) all[name] = value;
  return all;
}

}  // namespace

void write_map(const std::filesystem::path& path, const OrientationMap& map) {
  hdf5::File file = hdf5::File::create(path);
  file.set("schema", "kreisel map");
  file.set("schema_version", map_schema_version);
  file.set("model", map.body_name);
  file.set("problem", map.config.problem);
  file.set("cases", fmt::format("{}", fmt::join(map.cases, "\n")));
  file.set("through", map.through == Through::centre ? "centre" : "lowest");
  file.set("axes_asked", map.asked);
  file.set("complete", map.axes.size() == map.asked);
  file.set("setup_seconds", map.setup_seconds);
  file.set("sweep_seconds", map.sweep_seconds);
  const auto best = map.best();
  file.set("best_axis", best ? static_cast<int>(best->axis) : -1);
  file.set("best_case", best ? static_cast<int>(best->at_case) : -1);
  file.set("best_command", best ? map.command(*best) : "");

  const hdf5::Shape shape{map.axes.size(), map.cases.size()};
  write_vectors(file, "axes", map.axes, "1");
  write_vectors(file, "contacts", map.contacts, "mm");
  file.write("feasible",
             column(map,
                    [](const MapAnswer& a) {
                      return a.status == MapAnswer::undecided ? -1 : a.status == MapAnswer::feasible ? 1 : 0;
                    }),
             shape, {"1", map.cases});
  file.write("ok", column(map, [](const MapAnswer& a) { return a.verdict.ok ? 1 : 0; }), shape,
             {"1", map.cases});
  file.write("objective", column(map, [](const MapAnswer& a) { return a.objective; }), shape,
             {"1", map.cases});
  file.write("miss", column(map, [](const MapAnswer& a) { return a.miss; }), shape,
             {"body units", map.cases});
  write_values(file.new_group("values"), map);  // apart: a problem chooses these names
  write_config(file.new_group("config"), describe(map.config));
  write_provenance(file.new_group("provenance"), map.provenance);
  write_domain(file.new_group("domain"), map);
  file.close();
}

json to_json(const OrientationMap& map) {
  json cases = json::array(), axes = json::array();
  for (std::size_t c = 0; c < map.cases.size(); ++c)
    cases.push_back({{"draft", map.cases[c].empty() ? json(nullptr) : json(map.cases[c])},
                     {"feasible", map.count(c, MapAnswer::feasible)},
                     {"infeasible", map.count(c, MapAnswer::infeasible)},
                     {"undecided", map.count(c, MapAnswer::undecided)},
                     {"ok", map.count_ok(c)}});
  for (std::size_t a = 0; a < map.axes.size(); ++a) {
    json answers = json::array();
    for (std::size_t c = 0; c < map.cases.size(); ++c) answers.push_back(to_json(map.at(a, c)));
    axes.push_back(
        {{"axis", json_list(map.axes[a])}, {"contact", json_list(map.contacts[a])}, {"answers", answers}});
  }
  json best = nullptr;
  if (const auto place = map.best()) {
    best = to_json(map.at(place->axis, place->at_case));
    best["axis"] = json_list(map.axes[place->axis]);
    best["contact"] = json_list(map.contacts[place->axis]);
    best["draft"] = cases[place->at_case]["draft"];
    best["text"] = map.at(place->axis, place->at_case).verdict.text;
    best["command"] = map.command(*place);
  }
  const json all = {{"model", map.body_name},
                    {"problem", map.config.problem},
                    {"formulation", map.config.formulation},
                    {"solver", map.config.solver},
                    {"grid", map.grid.n},
                    {"rays", map.rays},
                    {"domain", map.domain},
                    {"through", map.through == Through::centre ? "centre" : "lowest"},
                    {"axes_asked", map.asked},
                    {"termination", map.axes.size() == map.asked ? "complete" : "interrupted"},
                    {"seconds", {{"setup", map.setup_seconds}, {"sweep", map.sweep_seconds}}},
                    {"cases", cases},
                    {"best", best},
                    {"axes", axes},
                    {"config", describe(map.config)},
                    {"device", map.provenance.device},
                    {"commit", map.provenance.commit}};
  // NaN becomes null, bytes that are no UTF-8 the replacement character.
  return json::parse(all.dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace kreisel::core
