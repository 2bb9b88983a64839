#include "table/published.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

#include "error.hpp"
#include "problem/problem.hpp"
#include "table/columns.hpp"

namespace kreisel::core {
namespace {

using nlohmann::json;

/// What is fixed for all rows: whoever reads numbers may count on these being what they are.
void require_row(const json& row) {
  (void)row.at("model").get<std::string>();
  if (row.contains("grid") && row.at("grid").get<std::vector<int>>().size() != 3)
    throw InputError("a grid that is no list of three");
  for (const char* name : {"problem", "label", "solver"})
    if (row.contains(name)) (void)row.at(name).get<std::string>();
  if (row.contains("settings")) (void)row.at("settings").get<std::map<std::string, std::string>>();
  for (const auto& [name, value] : row.items())
    if (value.is_null() || (value.is_string() && name.find("seconds") != name.npos))
      throw InputError(fmt::format("{} that is no number", name));
}

bool same_text(const json& row, const char* name, const json& of_run) {
  return !row.contains(name) || of_run.is_null() || row.at(name) == of_run;
}

bool same_label(const json& row, const std::string& label) {
  if (!row.contains("label")) return true;
  const std::string printed = row.at("label");
  return label == printed || label.starts_with(printed + ",");
}

bool same_settings(const json& row, const RecordedRun& run) {
  if (!row.contains("settings")) return true;
  auto settings = run.fields();
  for (const ProblemEntry& problem : problems())
    if (problem.name == settings["problem"])
      for (const auto& [name, value] : problem.usual_weights())
        settings.try_emplace("problem." + name, value);
  return std::ranges::all_of(row.at("settings").items(), [&](const auto& wanted) {
    const auto found = settings.find(wanted.key());
    return found != settings.end() && found->second == wanted.value();
  });
}

}  // namespace

bool belongs(const json& row, const RecordedRun& run) {
  const json grid = value_of(run, "grid");
  const bool same_grid =
      !row.contains("grid") || grid == fmt::format("{}", fmt::join(row["grid"].get<std::vector<int>>(), "x"));
  return same_grid && same_label(row, run.run.label) && same_text(row, "model", value_of(run, "model")) &&
         same_text(row, "problem", value_of(run, "problem")) && same_settings(row, run);
}

const json* Published::find(const RecordedRun& run) const {
  const auto at = std::ranges::find_if(rows, [&](const json& row) { return belongs(row, run); });
  return at == rows.end() ? nullptr : &*at;
}

Published read_published(const std::filesystem::path& file) {
  const auto refuse = [&](std::string what) {
    std::replace(what.begin(), what.end(), '\n', ' ');
    return InputError(
        fmt::format("{}: {}, expected source, machine and rows of published numbers", file.string(), what));
  };
  std::ifstream stream(file);
  if (!stream) throw InputError(fmt::format("{}: cannot be read, expected published numbers", file.string()));
  try {
    const json read = json::parse(stream);
    Published published{read.at("source"), read.at("machine"), read.at("rows")};
    for (const json& row : published.rows) require_row(row);
    return published;
  } catch (const json::exception& error) {
    throw refuse(error.what());
  } catch (const InputError& error) {
    throw refuse(error.what());
  }
}

}  // namespace kreisel::core
