// across_nodes.hpp - times of different machines in one number: a mark, and the line that explains it.
#pragma once

#include <string>

#include "table/row.hpp"
#include "table/sheet.hpp"

namespace kreisel::core {

/// Whether an expression takes times of runs that were not all made on one node and processor. What has no
/// such word on record, as early records, is like any other.
[[nodiscard]] bool is_across_nodes(const Row& row, const std::string& expression);
[[nodiscard]] bool are_across_nodes(const RecordedRun& a, const RecordedRun& b);

/// Marks the text of a cell that is so.
void mark_across_nodes(Cell& cell);
/// What the mark means, a line; empty where no cell of the tables has it.
[[nodiscard]] std::string across_nodes_legend(const Tables& tables);

}  // namespace kreisel::core
