// table_parts.hpp - what the tables that are made by code share.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "table/columns.hpp"
#include "table/provenance_text.hpp"
#include "table/sheet.hpp"

namespace kreisel::core {

inline constexpr std::string_view certified_legend =
    "gap %: f lies no further above the least that any interior of the domain has, certified\n";

[[nodiscard]] inline Runs pointers(const std::vector<RecordedRun>& runs) {
  Runs all;
  for (const RecordedRun& run : runs) all.push_back(&run);
  return all;
}

/// A column's cell, as a layout would show it.
[[nodiscard]] inline Cell cell_of_column(const RecordedRun& run, std::string_view name) {
  const Column* column = find_column(name);
  Cell cell = cell_of(value_of(run, name), std::string(column ? column->format : ""), ", ");
  if (column && column->text) cell.text = column->text(run);
  return cell;
}

/// Does any of them have a certificate? Tables have a column for the gap then.
[[nodiscard]] inline bool any_certified(const std::vector<RecordedRun>& runs) {
  return Condition{"gap_percent"}.any(pointers(runs));
}

}  // namespace kreisel::core
