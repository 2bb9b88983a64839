// sheet.hpp - a table's rows, written once, read as aligned text, CSV or JSON.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "table/text_table.hpp"

namespace kreisel::core {

/// A value as people read it and as programs do.
struct Cell {
  std::string text;  ///< "-" where there is none
  std::string data;  ///< all digits; empty where there is none

  Cell(std::string both) : text(both.empty() ? "-" : both), data(std::move(both)) {}
  Cell(const char* both) : Cell(std::string(both)) {}
  Cell(std::string shown, std::string raw) : text(std::move(shown)), data(std::move(raw)) {}

  /// @param format  of the text; the data have all digits. Empty and NaN: no value
  static Cell of(const std::optional<double>& value, fmt::format_string<const double&> format);
  static Cell none() { return {"-", ""}; }
};

/// Rows of cells under columns, of which some are for readers alone and some for programs alone.
class Sheet {
 public:
  struct Column {
    std::string data;            ///< heading in CSV; empty: not there
    std::string group, heading;  ///< in text, as TextTable has them; heading empty: not there
    bool left = false;
    bool hidden = false;  ///< not in text, though it has a heading there

    [[nodiscard]] bool shown() const { return !heading.empty() && !hidden; }
  };

  explicit Sheet(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// @throws std::invalid_argument  not one cell a column
  void add(std::vector<Cell> row);

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  [[nodiscard]] const std::vector<std::vector<Cell>>& rows() const { return rows_; }

  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string csv_heading() const;
  [[nodiscard]] std::string csv_rows() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// One sheet with what stands above and below it.
struct Block {
  std::string heading;  ///< lines without a newline at the end; may be empty
  Sheet sheet;
  std::string notes;  ///< lines, each with its newline; may be empty
};

/// All of an experiment. Every block has the same columns.
struct Tables {
  std::vector<Block> blocks;
  std::string legend;  ///< what the columns mean and where the numbers come from; lines
};

/// Blocks with an empty line between them, then the legend. Ends with a newline.
[[nodiscard]] std::string to_text(const Tables& tables);
/// The rows of all blocks under one heading line; missing values are empty.
[[nodiscard]] std::string to_csv(const Tables& tables);

}  // namespace kreisel::core
