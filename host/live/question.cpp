#include "live/question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "parse.hpp"
#include "problem/problem.hpp"
#include "session/made_fields.hpp"
#include "session/ranges.hpp"
#include "settings/field_text.hpp"

namespace kreisel::core::live {
namespace {

/// Groups of which a request may set all that names no shape: what is of this machine is not among them.
bool is_open(const Field<RunConfig>& field) {
  static const std::set<std::string_view> groups = {"body", "mesh", "pose and material",
                                                    "the problem's settings", "deformation"};
  static const std::set<std::string_view> others = {"problem", "resolution", "wall"};
  return !field.shapes && (groups.contains(field.group) || others.contains(field.name));
}

/// Balls alone: anything else would be the name of a file.
void require_balls(std::string_view key, std::string_view value) {
  for (const std::string_view one : field_text::split(value, ';')) {
    const auto numbers = field_text::split(one, ',');
    const auto is_number = [](std::string_view n) { return parse<double>(n).has_value(); };
    if (numbers.size() != 4 || !std::ranges::all_of(numbers, is_number))
      field_text::refuse(key, value, "balls x,y,z,r in mm, apart by ';'");
  }
}

void require_few_cells(const RunConfig& config, std::string_view key, std::string_view value) {
  constexpr int most = 256;
  const auto& cells = config.grid.cells;
  if ((cells ? std::ranges::max(*cells) : config.grid.resolution) > most)
    field_text::refuse(key, value, fmt::format("at most {} cells here", most));
}

void require_not_fine(const RunConfig& config, std::string_view key, std::string_view value) {
  constexpr int most = 256;
  if (config.body.fineness > most) field_text::refuse(key, value, fmt::format("at most {} here", most));
}

/// With what a request may not do beside it.
Field<RunConfig> guarded(Field<RunConfig> field) {
  const auto set = field.set;
  if (field.name == "keep")
    field.set = [set](RunConfig& c, std::string_view k, std::string_view v) {
      require_balls(k, v), set(c, k, v);
    };
  if (field.name == "resolution")
    field.set = [set](RunConfig& c, std::string_view k, std::string_view v) {
      set(c, k, v), require_few_cells(c, k, v);
    };
  if (field.name == "fineness")
    field.set = [set](RunConfig& c, std::string_view k, std::string_view v) {
      set(c, k, v), require_not_fine(c, k, v);
    };
  return field;
}

}  // namespace

const Fields<RunConfig>& open_fields() {
  static const Fields<RunConfig> all = [] {
    Fields<RunConfig> fields;
    for (const Field<RunConfig>& field : solve_fields())
      if (is_open(field)) fields.push_back(guarded(field));
    return fields;
  }();
  return all;
}

const Fields<RunConfig>& body_fields() {
  static const Fields<RunConfig> all = [] {
    Fields<RunConfig> fields;
    for (const Field<RunConfig>& field : open_fields())
      if ((field.group == "body" || field.group == "mesh") && field.name != "size") fields.push_back(field);
    return fields;
  }();
  return all;
}

RunConfig usual_question() {
  RunConfig config;
  config.formulation = "quadric";
  config.grid.resolution = 96;
  config.wall = parse_wall("1.2");
  config.part = Part::none;
  return config;
}

std::string text_of_field(const std::string& name, const nlohmann::json& value) {
  if (!value.is_string()) throw InputError(fmt::format("field '{}'; expected its value as a text", name));
  return value.get<std::string>();
}

nlohmann::json field_json(std::string_view name, std::string_view unit, std::string_view help,
                          std::string_view group, const std::string& usual, const Choices& choices) {
  nlohmann::json one = {{"name", name}, {"unit", unit}, {"help", help}, {"group", group}, {"usual", usual}};
  if (choices) one["choices"] = choices();
  if (const auto range = range_of(name))
    one["range"] = {{"low", range->low}, {"high", range->high}, {"suffix", range->suffix}};
  return one;
}

nlohmann::json problems_json() {
  nlohmann::json all = nlohmann::json::array();
  for (const ProblemEntry& problem : problems())
    all.push_back({{"name", problem.name},
                   {"help", problem.made.help.empty() ? problem.summary : problem.made.help},
                   {"upright", problem.upright},
                   {"shape", made_shape(problem)},
                   {"settings", made_settings(problem)},
                   {"begins", problem.made.settings},
                   {"mapped", problem.map.has_value()}});
  return all;
}

}  // namespace kreisel::core::live
