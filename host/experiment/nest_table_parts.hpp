// nest_table_parts.hpp - what the tables of nestings share.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "experiment/provenance_text.hpp"
#include "experiment/run_text.hpp"
#include "experiment/table.hpp"

namespace kreisel::core {

[[nodiscard]] inline bool has_nesting(const RecordedRun& run) { return run.nest && run.nest->error.empty(); }

/// Why a run has no result; empty where it has one.
[[nodiscard]] inline std::string note_of_nesting(const RecordedRun& run) {
  if (has_nesting(run)) return {};
  return fmt::format("{}: {}\n", run_text(run.run), run.nest ? "error - " + run.nest->error : "not run");
}

[[nodiscard]] inline std::string provenance_of_nestings(const std::vector<RecordedRun>& runs) {
  return provenance_text(runs) + '\n';
}

/// What each pair of shapes has, in the order of the runs.
[[nodiscard]] inline std::vector<std::string> shapes_of(const std::vector<RecordedRun>& runs) {
  std::vector<std::string> all;
  for (const RecordedRun& run : runs)
    if (const std::string shapes = shapes_text(run.run.nesting()); std::ranges::find(all, shapes) == all.end())
      all.push_back(shapes);
  return all;
}

}  // namespace kreisel::core
