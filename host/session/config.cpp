#include "session/config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "deform/deform_settings.hpp"
#include "error.hpp"
#include "formulation/formulation.hpp"
#include "problem/problem.hpp"
#include "settings/field_text.hpp"
#include "solve/solver.hpp"
#include "unknown_name.hpp"

namespace kreisel::core {

const std::vector<std::string_view>& setting_groups() {
  static const std::vector<std::string_view> all = [] {
    std::vector<std::string_view> groups = {"problem", "formulation", "solver", "deform"};
    for (const SolverEntry& solver : solvers())
      if (!solver.settings.fields().empty()) groups.push_back(solver.name);
    return groups;
  }();
  return all;
}

bool is_setting(std::string_view key) {
  return std::ranges::any_of(setting_groups(), [&](std::string_view group) {
    return key.size() > group.size() + 1 && key.starts_with(group) && key[group.size()] == '.';
  });
}

void set_setting(Asked& asked, std::string_view key, std::string_view value) {
  if (!is_setting(key))
    throw unknown_name(fmt::format("setting '{}': group", key), key.substr(0, key.find('.')),
                       setting_groups());
  asked.settings[std::string(key)] = value;
}

void set_field(RunConfig& config, std::string_view key, std::string_view value) {
  if (key.find('.') != std::string_view::npos)
    set_setting(config, key, value);
  else
    set_field(solve_fields(), config, key, value);
}

std::string solver_of(const Asked& asked) {
  return std::string(asked.solver.empty() ? default_solver(asked.formulation).name : asked.solver);
}

std::string domain_of(const Asked& asked) {
  const FormulationEntry& formulation = find_formulation(asked.formulation);
  if (asked.domain.empty()) return formulation.domains.front();
  if (std::ranges::find(formulation.domains, asked.domain) != formulation.domains.end()) return asked.domain;
  std::vector<std::string_view> others;
  for (const FormulationEntry& other : formulations())
    if (std::ranges::find(other.domains, asked.domain) != other.domains.end()) others.push_back(other.name);
  throw InputError(fmt::format("domain '{}' does not work with formulation '{}'; it works with: {}",
                               asked.domain, asked.formulation, fmt::join(others, ", ")));
}

SettingTexts settings_of(const Asked& asked, std::string_view group) {
  SettingTexts result;
  for (const auto& [key, value] : asked.settings)
    if (key.starts_with(group) && key.size() > group.size() && key[group.size()] == '.')
      result[key.substr(group.size() + 1)] = value;
  return result;
}

Settings problem_settings(const Asked& asked) {
  return find_problem(asked.problem).read(settings_of(asked, "problem"));
}

std::vector<std::string> setting_names(const std::vector<std::string_view>& groups) {
  std::set<std::string> names;
  const auto add = [&](std::string_view group, const SettingTable& table) {
    if (std::ranges::find(groups, group) != groups.end())
      for (const Field<Settings>& field : table.fields())
        names.insert(fmt::format("{}.{}", group, field.name));
  };
  for (const ProblemEntry& problem : problems()) add("problem", problem.settings);
  for (const FormulationEntry& formulation : formulations()) add("formulation", formulation.settings);
  add("solver", solver_settings());
  add("deform", deform_settings());
  for (const SolverEntry& solver : solvers()) add(solver.name, solver.settings);
  return {names.begin(), names.end()};
}

void require_setting(const Asked& asked, std::string_view key, const std::string& value) {
  const std::size_t dot = key.find('.');
  const std::string group(key.substr(0, dot));
  const SettingTexts one = {{std::string(key.substr(dot + 1)), value}};
  if (group == "problem")
    (void)find_problem(asked.problem).read(one);
  else if (group == "formulation")
    (void)find_formulation(asked.formulation).settings.read(one, group, asked.formulation);
  else if (group == "solver")
    (void)parse_solver_options(one);
  else if (group == "deform")
    (void)deform_settings().read(one, group, "--deform");
  else
    (void)solvers().find(group).read(one);
}

void require_settings(const Asked& asked) {
  for (const auto& [key, value] : asked.settings) require_setting(asked, key, value);
}

std::map<std::string, std::string> describe(const RunConfig& config) {
  auto said = describe(solve_fields(), config, RunConfig());
  said.insert(config.settings.begin(), config.settings.end());
  return said;
}

std::string model_text(const Asked& asked) { return std::filesystem::path(asked.body.model).stem().string(); }

std::string grid_text(const GridSpec& grid) {
  return grid.cells ? fmt::format("{}", fmt::join(*grid.cells, "x")) : std::to_string(grid.resolution);
}

std::string run_name(const Asked& asked, const std::map<std::string, std::string>& fields,
                     std::string_view way) {
  return fmt::format("{}-{}-{}-{}-{:08x}", model_text(asked), grid_text(asked.grid), asked.problem, way,
                     field_text::hash(fields));
}

std::string run_name(const RunConfig& config) {
  return run_name(config, describe(config), config.formulation + "-" + solver_of(config));
}

}  // namespace kreisel::core
