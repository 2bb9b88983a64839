// columns.cpp - `bench columns`, and values of columns: what tables, CSV and figures call by name.
#include "table/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/bench/commands.hpp"
#include "apps/shared/outputs.hpp"
#include "file/write_text.hpp"
#include "table/data_folder.hpp"
#include "table/row.hpp"
#include "table/sheet.hpp"

namespace kreisel::core::bench {
namespace {

using nlohmann::json;

/// Parts between commas that stand in no brackets: "grid,ratio(seconds, formulation=voxel)" has two.
std::vector<std::string> expressions_of(const std::string& text) {
  std::vector<std::string> all(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
    if (c == ',' && depth == 0)
      all.emplace_back();
    else
      all.back() += c;
  }
  return all;
}

json json_of(const std::vector<Row>& rows, const std::vector<std::string>& names) {
  json all = json::array();
  for (const Row& row : rows) {
    json& values = all.emplace_back(json{{"path", row.runs.front()->path().string()}});
    for (const std::string& name : names) values[name] = value_of(row, name);
  }
  return all;
}

Sheet sheet_of(const std::vector<Row>& rows, const std::vector<std::string>& names) {
  std::vector<Sheet::Column> headings;
  for (const std::string& name : names) {
    const Column* column = find_column(name);
    headings.push_back({.data = name, .group = "", .heading = name, .left = column && column->left});
  }
  Sheet sheet(std::move(headings));
  for (const Row& row : rows) {
    std::vector<Cell> cells;
    for (const std::string& name : names) {
      const Column* column = find_column(name);
      Cell cell = cell_of(value_of(row, name), column ? std::string(column->format) : "", ", ");
      if (column && column->text) cell.text = column->text(*row.runs.front());
      cells.push_back(std::move(cell));
    }
    sheet.add(std::move(cells));
  }
  return sheet;
}

Published published_of(const std::string& name) {
  return read_published(name.ends_with(".json") ? std::filesystem::path(name) : published_file(name));
}

}  // namespace

int show_columns(const ShowOptions& options, const std::vector<std::filesystem::path>& records) {
  require_writable(options.json_file, "--json");
  const std::vector<std::string> names = expressions_of(options.columns);
  const Published published = options.published.empty() ? Published() : published_of(options.published);
  std::vector<RecordedRun> runs;
  for (const std::filesystem::path& record : records) runs.push_back({{}, read_record(record)});
  Runs all;
  for (const RecordedRun& run : runs) all.push_back(&run);
  const RunGroup group(std::move(all));
  std::vector<Row> rows;
  for (const RecordedRun* run : group.runs())
    rows.push_back(
        {.runs = {run}, .group = &group, .published = options.published.empty() ? nullptr : &published});
  if (options.json_file.empty()) {
    fmt::print("{}", sheet_of(rows, names).text());
    return done;
  }
  const std::string text = json_of(rows, names).dump(2, ' ', false, json::error_handler_t::replace) + "\n";
  if (options.json_file == "-")
    fmt::print("{}", text);
  else
    write_text(options.json_file, text);
  return done;
}

int list_columns(bool markdown) {
  if (markdown) {
    fmt::print("| column | heading | unit |\n|---|---|---|\n");
    for (const Column& column : columns())
      fmt::print("| `{}` | {} | {} |\n", column.name, column.heading, column.unit);
    return done;
  }
  TextTable table({{"", "column", true}, {"", "heading", true}, {"", "unit", true}});
  for (const Column& column : columns())
    table.add({std::string(column.name), std::string(column.heading), std::string(column.unit)});
  fmt::print("{}", table.text());
  return done;
}

}  // namespace kreisel::core::bench
