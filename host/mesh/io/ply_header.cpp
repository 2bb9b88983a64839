#include "mesh/io/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "mesh/io/text.hpp"
#include "parse.hpp"

namespace kreisel::core::ply {
namespace {

/// Lines of the header, counted for the errors.
class HeaderLines {
 public:
  explicit HeaderLines(const MeshFile& file) : file_(file), rest_(text_of(file)) {
    // As the first line ends, so do all: the body may begin with any byte, a line feed among them.
    const std::string_view first = rest_.substr(0, rest_.find('\n'));
    const std::size_t back = first.find('\r');
    if (back < first.size() - 1 && back != std::string_view::npos) end_ = '\r';
  }

  std::string_view next() {
    const std::size_t end = rest_.find(end_);
    ++number_;
    if (end == std::string_view::npos)
      throw error("the header ends without 'end_header', expected a whole file");
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return line;
  }
  [[nodiscard]] std::string_view rest() const { return rest_; }
  [[nodiscard]] InputError error(std::string_view what) const {
    return InputError(fmt::format("{}: line {}: {}", file_.name, number_, what));
  }

 private:
  const MeshFile& file_;
  std::string_view rest_;
  char end_ = '\n';
  std::size_t number_ = 0;
};

Type type_of(std::string_view word, const HeaderLines& lines) {
  // Each type has two names in use.
  static constexpr std::array<std::pair<std::string_view, Type>, 16> names{{{"char", Type::int8},
                                                                            {"int8", Type::int8},
                                                                            {"uchar", Type::uint8},
                                                                            {"uint8", Type::uint8},
                                                                            {"short", Type::int16},
                                                                            {"int16", Type::int16},
                                                                            {"ushort", Type::uint16},
                                                                            {"uint16", Type::uint16},
                                                                            {"int", Type::int32},
                                                                            {"int32", Type::int32},
                                                                            {"uint", Type::uint32},
                                                                            {"uint32", Type::uint32},
                                                                            {"float", Type::float32},
                                                                            {"float32", Type::float32},
                                                                            {"double", Type::float64},
                                                                            {"float64", Type::float64}}};
  for (const auto& [name, type] : names)
    if (name == word) return type;
  throw lines.error(
      fmt::format("type '{}', expected a number type of PLY such as float or uchar", shown(word)));
}

Encoding encoding_of(std::string_view word, const HeaderLines& lines) {
  if (word == "ascii") return Encoding::ascii;
  if (word == "binary_little_endian") return Encoding::little_endian;
  if (word == "binary_big_endian") return Encoding::big_endian;
  throw lines.error(
      fmt::format("format '{}', expected ascii, binary_little_endian or binary_big_endian", shown(word)));
}

Property property_of(std::string_view line, const HeaderLines& lines) {
  Property property{};
  std::string_view type = next_word(line);
  if (type == "list") {
    property.count_type = type_of(next_word(line), lines);
    if (*property.count_type == Type::float32 || *property.count_type == Type::float64)
      throw lines.error("list length of a floating-point type, expected an integer type");
    type = next_word(line);
  }
  property.type = type_of(type, lines);
  property.name = shown(next_word(line));
  if (property.name.empty()) throw lines.error("property without a name, expected 'property TYPE NAME'");
  return property;
}

}  // namespace

Header read_header(const MeshFile& file) {
  HeaderLines lines(file);
  if (std::string_view first = text_of(file).substr(0, 4); next_word(first) != "ply")
    throw InputError(fmt::format("{}: does not begin with 'ply', expected a PLY file", file.name));
  (void)lines.next();
  Header header{};
  bool format_seen = false;
  for (;;) {
    std::string_view line = lines.next();
    const std::string_view word = next_word(line);
    if (word == "end_header") break;
    if (word == "format") {
      header.encoding = encoding_of(next_word(line), lines);
      format_seen = true;
    } else if (word == "element") {
      const std::string_view name = next_word(line), number = next_word(line);
      const auto count = parse<std::uint64_t>(number);
      if (!count)
        throw lines.error(
            fmt::format("element '{}' of count '{}', expected a number", shown(name), shown(number)));
      header.elements.push_back({shown(name), *count, {}});
    } else if (word == "property") {
      if (header.elements.empty()) throw lines.error("property before any element, expected 'element' first");
      header.elements.back().properties.push_back(property_of(line, lines));
    } else if (!word.empty() && word != "comment" && word != "obj_info") {
      throw lines.error(fmt::format("'{}', expected a word of a PLY header", shown(word)));
    }
  }
  for (const Element& element : header.elements)  // nothing would tell where such elements end
    if (element.properties.empty() && element.count)
      throw lines.error(fmt::format("element '{}' has no property, expected one or more", element.name));
  if (!format_seen) throw lines.error("the header has no 'format', expected ascii or binary");
  header.body = lines.rest();
  return header;
}

}  // namespace kreisel::core::ply
