// columns.hpp - what tables call by name: what a run was asked, what its record says, what follows from both.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "table/recorded_run.hpp"
#include "table/sheet.hpp"

namespace kreisel::core {

/// A column that is more than a value of a summary: worked out, or shown in a way of its own.
struct Column {
  std::string_view name, heading;
  std::string_view unit;         ///< empty: text, or a number without unit
  bool left = false;             ///< aligned so
  std::string_view format = {};  ///< of fmt, such as ".2f"; empty: the value's own
  nlohmann::json (*value)(const RecordedRun& run);
  /// As people read it where that is no formatted number, such as "0.25 ± 0.01"; may be nullptr.
  std::string (*text)(const RecordedRun& run) = nullptr;
};

[[nodiscard]] const std::vector<Column>& columns();

/// nullptr: there is none of that name; it may still be one of a summary or a field.
[[nodiscard]] const Column* find_column(std::string_view name);

/// A column's, else what the summary has under that name, else a field's text of what was asked (that alone
/// as "asked.NAME"); null: nothing.
[[nodiscard]] nlohmann::json value_of(const RecordedRun& run, std::string_view name);

/// A value as a cell: numbers by `format` with all digits behind it, lists with `join` between their items.
[[nodiscard]] Cell cell_of(const nlohmann::json& value, const std::string& format, const std::string& join);

}  // namespace kreisel::core
