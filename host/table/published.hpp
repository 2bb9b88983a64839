// published.hpp - a paper's own numbers, read from results/published.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace kreisel::core {

struct RecordedRun;

/// What a paper prints. A row says of which run it is by model, grid, problem, label, solver and settings, as
/// far as it has them; all else are numbers, which tables call by "published.NAME" (results/README.md).
struct Published {
  std::string source, machine;
  nlohmann::json rows = nlohmann::json::array();

  /// The first row that fits the run; nullptr where there is none. A row without a grid fits every grid, and
  /// so on; one with a label fits "LABEL" and "LABEL, more".
  [[nodiscard]] const nlohmann::json* find(const RecordedRun& run) const;
};

/// Whether the row is about this run.
[[nodiscard]] bool belongs(const nlohmann::json& row, const RecordedRun& run);

/// @throws InputError  unreadable, not JSON, or a field missing or of another type; names file and fault
[[nodiscard]] Published read_published(const std::filesystem::path& file);

}  // namespace kreisel::core
