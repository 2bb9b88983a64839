#include "table/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace kreisel::core {
namespace {

std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;  // not a continuation byte
  }));
}

enum class Align { left, right, centre };

std::string padded(const std::string& text, std::size_t width, Align align) {
  const std::size_t used = width_of(text);
  const std::size_t blanks = width > used ? width - used : 0;
  const std::size_t before = align == Align::left ? 0 : align == Align::right ? blanks : blanks / 2;
  return std::string(before, ' ') + text + std::string(blanks - before, ' ');
}

void end_line(std::string& text) {
  text.erase(text.find_last_not_of(' ') + 1);
  text += '\n';
}

constexpr std::string_view gap = "  ", bar = " | ";

}  // namespace

void TextTable::add(std::vector<std::string> row) {
  if (row.size() != columns_.size())
    throw std::invalid_argument(fmt::format("{} cells for {} columns", row.size(), columns_.size()));
  rows_.push_back(std::move(row));
}

std::string TextTable::text() const {
  const std::size_t count = columns_.size();
  std::vector<std::size_t> width(count);
  for (std::size_t c = 0; c < count; ++c) {
    width[c] = width_of(columns_[c].heading);
    for (const auto& row : rows_) width[c] = std::max(width[c], width_of(row[c]));
  }

  // Spans of columns of one group; a name longer than its columns widens the first of them.
  struct Stretch {
    std::size_t first, last, width;
  };
  std::vector<Stretch> spans;
  for (std::size_t c = 0; c < count; ++c) {
    if (spans.empty() || columns_[c].group != columns_[spans.back().first].group)
      spans.push_back({c, c, width[c]});
    else
      spans.back() = {spans.back().first, c, spans.back().width + gap.size() + width[c]};
  }
  for (Stretch& span : spans) {
    const std::size_t name = width_of(columns_[span.first].group);
    if (name > span.width) width[span.first] += name - span.width, span.width = name;
  }

  std::string text;
  const auto line = [&](auto&& cell, Align forced) {
    std::string out;
    for (std::size_t s = 0; s < spans.size(); ++s) {
      if (s > 0) out += bar;
      for (std::size_t c = spans[s].first; c <= spans[s].last; ++c) {
        if (c > spans[s].first) out += gap;
        out += padded(cell(c), width[c], columns_[c].left ? Align::left : forced);
      }
    }
    end_line(out);
    text += out;
  };

  if (std::any_of(columns_.begin(), columns_.end(),
                  [](const auto& column) { return !column.group.empty(); })) {
    std::string names;
    for (std::size_t s = 0; s < spans.size(); ++s) {
      if (s > 0) names += bar;
      names += padded(columns_[spans[s].first].group, spans[s].width, Align::centre);
    }
    end_line(names);
    text += names;
  }
  line([&](std::size_t c) { return columns_[c].heading; }, Align::right);
  for (std::size_t s = 0; s < spans.size(); ++s)
    text += (s > 0 ? "-+-" : "") + std::string(spans[s].width, '-');
  text += '\n';
  for (const auto& row : rows_) line([&](std::size_t c) { return row[c]; }, Align::right);
  return text;
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    if (cells[i].find_first_of(",\"\r\n") == std::string::npos) {
      line += cells[i];
      continue;
    }
    line += '"';
    for (const char c : cells[i]) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line + '\n';
}

}  // namespace kreisel::core
