// nest_variants_table.hpp - the table "nest-variants": what a setting of a search reaches, over its seeds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "table/published.hpp"
#include "table/recorded_run.hpp"
#include "table/sheet.hpp"

namespace kreisel::core {

/// A block for every pair of shapes, a row a setting with the highest median first: median and spread of the
/// scales over its seeds, how many come near the best of all, how many reach a paper's.
[[nodiscard]] Tables nest_variants_tables(const std::vector<RecordedRun>& runs,
                                          const std::optional<Published>& published);

/// What tells each run's search from the others', its seed aside; "defaults" where nothing does.
[[nodiscard]] std::vector<std::string> settings_of_search(const std::vector<RecordedRun>& runs);

}  // namespace kreisel::core
