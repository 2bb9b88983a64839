// text_table.hpp - aligned plain text with grouped columns, and CSV.
#pragma once

#include <string>
#include <vector>

namespace kreisel::core {

/// Columns as wide as their longest cell. Neighbours of the same group stand under its name, groups are
/// parted by a bar. Widths count UTF-8 code points.
class TextTable {
 public:
  struct Column {
    std::string group, heading;
    bool left = false;  ///< aligned left; numbers stand right
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// @throws std::invalid_argument  not one cell a column
  void add(std::vector<std::string> row);

  /// Group names (when there are any), headings, a rule, the rows. Every line ends with a newline, none with
  /// blanks.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// One line of CSV (RFC 4180, but a plain newline at its end).
[[nodiscard]] std::string csv_line(const std::vector<std::string>& cells);

}  // namespace kreisel::core
