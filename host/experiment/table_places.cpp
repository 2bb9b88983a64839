#include "experiment/table_places.hpp"

#include <fmt/format.h>

#include <string_view>

#include "error.hpp"

namespace kreisel::core {
namespace {

constexpr std::string_view opening = "<!-- table:", closing = "<!-- end -->", closes = "-->";

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> parts;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    if (const auto part = trimmed(list.substr(0, comma)); !part.empty()) parts.emplace_back(part);
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return parts;
}

class Reader {
 public:
  Reader(const std::string& text, const std::filesystem::path& file) : text_(text), file_(file.string()) {}

  /// Calls visit(place, begin, end) with the bytes between its two marks.
  template <class Visit>
  void read(Visit visit) {
    std::optional<TablePlace> open;
    std::size_t begin = 0;
    for (std::size_t at = 0; at < text_.size(); ++line_) {
      const std::size_t after = std::min(text_.find('\n', at), text_.size() - 1) + 1;
      const std::string_view line = std::string_view(text_).substr(at, after - at);
      if (line.starts_with(opening)) {
        if (open) fail(fmt::format("a table within that of line {}, expected {} first", open->line, closing));
        open = place_of(trimmed(line).substr(opening.size()));
        begin = after;
      } else if (line.starts_with(closing)) {
        if (!open)
          fail(fmt::format("{} without a table, expected {} NAME {} before it", closing, opening, closes));
        open->content = trimmed(std::string_view(text_).substr(begin, at - begin));
        visit(*open, begin, at);
        open.reset();
      }
      at = after;
    }
    if (open) {
      line_ = open->line;
      fail(fmt::format("the table of {} has no end, expected a line {}", open->experiment, closing));
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: line {}: {}", file_, line_, what));
  }

  /// @param text  of the mark, after its colon
  TablePlace place_of(std::string_view text) const {
    if (!text.ends_with(closes)) fail(fmt::format("a mark that does not end, expected {}", closes));
    text = trimmed(text.substr(0, text.size() - closes.size()));
    TablePlace place;
    place.line = line_;
    place.experiment = text.substr(0, text.find(' '));
    if (place.experiment.empty()) fail("a table of no experiment, expected its name");
    for (text.remove_prefix(place.experiment.size()); !(text = trimmed(text)).empty();) {
      const std::size_t quote = text.find("=\""),
                        end = quote == text.npos ? quote : text.find('"', quote + 2);
      if (end == text.npos)
        fail(fmt::format("'{}', expected block=\"NAME\" or columns=\"NAME, NAME\"", text));
      const std::string_view key = text.substr(0, quote), value = text.substr(quote + 2, end - quote - 2);
      if (key == "block")
        place.selection.blocks.emplace_back(value);
      else if (key == "columns")
        place.selection.columns = split(value);
      else if (key == "joined" && value == "yes")
        place.selection.joined = true;
      else
        fail(fmt::format("{}=\"{}\" of a table, expected block, columns or joined=\"yes\"", key, value));
      text.remove_prefix(end + 1);
    }
    return place;
  }

  const std::string& text_;
  std::string file_;
  std::size_t line_ = 1;
};

}  // namespace

std::vector<TablePlace> table_places(const std::string& text, const std::filesystem::path& file) {
  std::vector<TablePlace> places;
  Reader(text, file).read([&](const TablePlace& place, std::size_t, std::size_t) {
    places.push_back(place);
  });
  return places;
}

std::string fill_places(const std::string& text, const std::filesystem::path& file,
                        const std::function<std::optional<std::string>(const TablePlace&)>& content_of) {
  std::string out;
  std::size_t copied = 0;
  Reader(text, file).read([&](const TablePlace& place, std::size_t begin, std::size_t end) {
    const std::optional<std::string> content = content_of(place);
    if (!content) return;
    out += text.substr(copied, begin - copied);
    out += fmt::format("\n{}\n\n", trimmed(*content));
    copied = end;
  });
  return out + text.substr(copied);
}

}  // namespace kreisel::core
