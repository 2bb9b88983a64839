#include "table/markdown_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <sstream>

#include "error.hpp"
#include "unknown_name.hpp"

namespace kreisel::core {
namespace {

constexpr std::size_t line_width = 120;

std::string name_of(const Block& block) { return block.heading.substr(0, block.heading.find('\n')); }

/// A bar would begin the next cell.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? "\\|" : std::string(1, c);
  return out;
}

std::string heading_of(const Sheet::Column& column) {
  if (column.heading.empty()) {
    std::string name = column.data;
    std::ranges::replace(name, '_', ' ');
    return name;
  }
  return column.group.empty() ? column.heading : fmt::format("{}: {}", column.group, column.heading);
}

std::vector<std::size_t> columns_of(const Sheet& sheet, const Selection& selection) {
  const auto& all = sheet.columns();
  std::vector<std::size_t> chosen;
  for (const std::string& name : selection.columns) {
    const auto at = std::ranges::find(all, name, &Sheet::Column::data);
    if (at == all.end()) {
      std::vector<std::string_view> names;
      for (const Sheet::Column& column : all)
        if (!column.data.empty()) names.push_back(column.data);
      throw unknown_name("column", name, names);
    }
    chosen.push_back(static_cast<std::size_t>(at - all.begin()));
  }
  if (!chosen.empty()) return chosen;
  for (std::size_t c = 0; c < all.size(); ++c)
    if (all[c].shown()) chosen.push_back(c);
  return chosen;
}

/// The rows of all these sheets, which have the same columns. @param sheets  not empty
std::string table_of(const std::vector<const Sheet*>& sheets, const Selection& selection) {
  const Sheet& first = *sheets.front();
  const std::vector<std::size_t> columns = columns_of(first, selection);
  std::string headings = "|", rule = "|", rows;
  for (const std::size_t c : columns) {
    headings += fmt::format(" {} |", escaped(heading_of(first.columns()[c])));
    rule += first.columns()[c].left ? "---|" : "---:|";
  }
  for (const Sheet* sheet : sheets)
    for (const auto& row : sheet->rows()) {
      rows += '|';
      for (const std::size_t c : columns) rows += fmt::format(" {} |", escaped(row[c].text));
      rows += '\n';
    }
  return headings + '\n' + rule + '\n' + rows;
}

/// "- TEXT", its further lines indented to stay in the item. Lengths are in bytes: a line may be a little
/// short.
std::string item(const std::string& text) {
  std::istringstream words(text);
  std::string out, line = "-";
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > line_width) {
      out += line + '\n';
      line.assign(1, ' ');
    }
    line += ' ' + word;
  }
  return out + line + '\n';
}

std::string list_of(const std::string& lines) {
  std::istringstream stream(lines);
  std::string out;
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) out += item(line);
  return out;
}

/// The heading's first line in bold, the rest as a list.
std::string heading_of(const Block& block) {
  if (block.heading.empty()) return "";
  const std::string name = name_of(block);
  const std::string rest = list_of(block.heading.substr(std::min(name.size() + 1, block.heading.size())));
  return fmt::format("**{}**\n\n{}{}", name, rest, rest.empty() ? "" : "\n");
}

std::vector<const Block*> blocks_of(const Tables& tables, const Selection& selection) {
  std::vector<const Block*> chosen;
  const auto add = [&](const std::string& beginning) {
    const std::size_t before = chosen.size();
    for (const Block& block : tables.blocks)
      if (block.heading.starts_with(beginning)) chosen.push_back(&block);
    return chosen.size() > before;
  };
  for (const std::string& name : selection.blocks) {
    if (add(name)) continue;
    std::vector<std::string> names;
    for (const Block& block : tables.blocks) names.push_back(name_of(block));
    throw unknown_name("block", name, names);
  }
  if (selection.blocks.empty()) add("");
  return chosen;
}

}  // namespace

std::string to_markdown(const Tables& tables, const Selection& selection) {
  const std::vector<const Block*> blocks = blocks_of(tables, selection);
  std::string text, notes;
  if (selection.joined && !blocks.empty()) {
    std::vector<const Sheet*> sheets;
    for (const Block* block : blocks) {
      sheets.push_back(&block->sheet);
      notes += list_of(block->notes);
    }
    text = table_of(sheets, selection) + '\n' + notes;
  } else {
    for (const Block* block : blocks) {
      if (!text.empty()) text += '\n';
      notes = list_of(block->notes);
      text += heading_of(*block) + table_of({&block->sheet}, selection) + (notes.empty() ? "" : "\n" + notes);
    }
    if (notes.empty()) text += '\n';  // else the legend goes on with their list
  }
  text += list_of(tables.legend);
  if (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace kreisel::core
