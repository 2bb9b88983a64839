#include "table/across_nodes.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace kreisel::core {

static constexpr std::string_view mark = " †";

bool are_across_nodes(const RecordedRun& a, const RecordedRun& b) {
  return std::ranges::any_of(std::array{"provenance.host", "provenance.processor"}, [&](const char* name) {
    const nlohmann::json of_a = a.at(name), of_b = b.at(name);
    return of_a.is_string() && of_b.is_string() && of_a != "" && of_b != "" && of_a != of_b;
  });
}

bool is_across_nodes(const Row& row, const std::string& expression) {
  if (is_operand(expression) || expression.find("seconds") == expression.npos) return false;
  const Runs runs = runs_in(row, expression);
  return std::ranges::any_of(runs,
                             [&](const RecordedRun* run) { return are_across_nodes(*runs.front(), *run); });
}

void mark_across_nodes(Cell& cell) { cell.text += mark; }

std::string across_nodes_legend(const Tables& tables) {
  for (const Block& block : tables.blocks)
    for (const std::vector<Cell>& row : block.sheet.rows())
      for (const Cell& cell : row)
        if (cell.text.ends_with(mark))
          return "†: of runs on different nodes or processors; such times say little about each other\n";
  return {};
}

}  // namespace kreisel::core
