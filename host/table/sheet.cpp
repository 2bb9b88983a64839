#include "table/sheet.hpp"

#include <cmath>
#include <stdexcept>

namespace kreisel::core {

Cell Cell::of(const std::optional<double>& value, fmt::format_string<const double&> format) {
  if (!value || std::isnan(*value)) return none();
  std::string text = fmt::format(format, *value);
  // A value that rounds to nothing has no sign.
  if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);
  return {text, fmt::format("{}", *value)};
}

void Sheet::add(std::vector<Cell> row) {
  if (row.size() != columns_.size())
    throw std::invalid_argument(fmt::format("{} cells for {} columns", row.size(), columns_.size()));
  rows_.push_back(std::move(row));
}

std::string Sheet::text() const {
  std::vector<TextTable::Column> shown;
  for (const Column& column : columns_)
    if (column.shown()) shown.push_back({column.group, column.heading, column.left});
  TextTable table(std::move(shown));
  for (const auto& row : rows_) {
    std::vector<std::string> cells;
    for (std::size_t c = 0; c < columns_.size(); ++c)
      if (columns_[c].shown()) cells.push_back(row[c].text);
    table.add(std::move(cells));
  }
  return table.text();
}

std::string Sheet::csv_heading() const {
  std::vector<std::string> names;
  for (const Column& column : columns_)
    if (!column.data.empty()) names.push_back(column.data);
  return csv_line(names);
}

std::string Sheet::csv_rows() const {
  std::string csv;
  for (const auto& row : rows_) {
    std::vector<std::string> cells;
    for (std::size_t c = 0; c < columns_.size(); ++c)
      if (!columns_[c].data.empty()) cells.push_back(row[c].data);
    csv += csv_line(cells);
  }
  return csv;
}

std::string to_text(const Tables& tables) {
  std::string text;
  for (const Block& block : tables.blocks) {
    if (!block.heading.empty()) text += block.heading + '\n';
    text += block.sheet.text() + block.notes;
    if (&block != &tables.blocks.back() || !tables.legend.empty()) text += '\n';
  }
  return text + tables.legend;
}

std::string to_csv(const Tables& tables) {
  std::string csv;
  for (const Block& block : tables.blocks) {
    if (csv.empty()) csv = block.sheet.csv_heading();
    csv += block.sheet.csv_rows();
  }
  return csv;
}

}  // namespace kreisel::core
