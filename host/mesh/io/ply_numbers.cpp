#include "mesh/io/ply_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "parse.hpp"

namespace kreisel::core::ply {
namespace {

static_assert(std::endian::native == std::endian::little, "byte order of binary PLY");

std::size_t size_of(Type type) {
  switch (type) {
    case Type::int8:
    case Type::uint8:
      return 1;
    case Type::int16:
    case Type::uint16:
      return 2;
    case Type::int32:
    case Type::uint32:
    case Type::float32:
      return 4;
    case Type::float64:
      break;
  }
  return 8;
}

}  // namespace

double Numbers::next(Type type) { return encoding_ == Encoding::ascii ? from_text() : from_bytes(type); }

double Numbers::coordinate(const Property& property) {
  const double value = next(property.type);
  if (!std::isfinite(value))
    throw error(fmt::format("coordinate {} is {}, expected a finite number", property.name, value));
  encoding_ == Encoding::ascii ? digits_.see(last_word_, value) : digits_.see(value);
  return value;
}

void Numbers::skip(const Property& property) {
  const std::size_t length = property.count_type ? list_length(property) : 1;
  for (std::size_t k = 0; k < length; ++k)
    if (encoding_ != Encoding::ascii)
      (void)from_bytes(property.type);
    else if (text_word().empty())
      throw cut_off();
}

std::size_t Numbers::list_length(const Property& property) {
  const double length = next(*property.count_type);
  if (!(length >= 0 && length == std::floor(length) && length <= double(UINT32_MAX)))
    throw error(fmt::format("list '{}' of length {}, expected 0 or more", property.name, length));
  return std::size_t(length);
}

void Numbers::require_end() {
  if (encoding_ == Encoding::ascii) {
    if (const std::string_view word = text_word(); !word.empty())
      throw InputError(fmt::format("{}: '{}' behind the last element, expected the end of the file",
                                   file_.name, shown(word)));
  } else if (rest_.find_first_not_of(" \t\r\n") != std::string_view::npos) {
    throw InputError(fmt::format("{}: {} bytes behind the last element, expected the end of the file",
                                 file_.name, rest_.size()));
  }
}

InputError Numbers::error(std::string_view what) const {
  return InputError(fmt::format("{}: {} {}: {}", file_.name, element_->name, index_ + 1, what));
}

std::string_view Numbers::text_word() { return last_word_ = next_word(rest_); }

InputError Numbers::cut_off() const {
  return error(fmt::format("the file ends here, expected {} of them", element_->count));
}

double Numbers::from_text() {
  const std::string_view word = text_word();
  if (word.empty()) throw cut_off();
  const auto value = parse<double>(word);
  if (!value) throw error(fmt::format("'{}', expected a finite number", shown(word)));
  return *value;
}

double Numbers::from_bytes(Type type) {
  char bytes[8] = {};
  const std::size_t size = size_of(type);
  if (rest_.size() < size) throw cut_off();
  std::memcpy(bytes, rest_.data(), size);
  rest_.remove_prefix(size);
  if (encoding_ == Encoding::big_endian) std::reverse(bytes, bytes + size);
  const auto as = [&]<class T>(T value) {
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  };
  switch (type) {
    case Type::int8:
      return as(std::int8_t{});
    case Type::uint8:
      return as(std::uint8_t{});
    case Type::int16:
      return as(std::int16_t{});
    case Type::uint16:
      return as(std::uint16_t{});
    case Type::int32:
      return as(std::int32_t{});
    case Type::uint32:
      return as(std::uint32_t{});
    case Type::float32:
      return as(float{});
    case Type::float64:
      break;
  }
  return as(double{});
}

}  // namespace kreisel::core::ply
