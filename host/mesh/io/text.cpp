#include "mesh/io/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "parse.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// How many characters at the front are so: find_first_not_of() looks each one up in a text, which took half
/// the time of reading.
template <class Is>
std::size_t count_front(std::string_view text, Is is) {
  return std::size_t(std::find_if_not(text.begin(), text.end(), is) - text.begin());
}

/// ASCII in two bytes each, of either order.
bool is_utf16(std::string_view bytes) {
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) return true;
  if (bytes.size() < 4) return false;
  const auto zero = [&](std::size_t i) { return bytes[i] == '\0'; };
  return zero(0) == zero(2) && zero(1) == zero(3) && zero(0) != zero(1);
}

}  // namespace

std::string_view text_of(const MeshFile& file) {
  std::string_view bytes = file.bytes;
  if (is_utf16(bytes))
    throw InputError(fmt::format("{}: text in UTF-16, expected ASCII or UTF-8", file.name));
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  return bytes;
}

std::string shown(std::string_view word) {
  constexpr std::size_t most = 40;
  std::string text(word.substr(0, most));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return word.size() > most ? text + "..." : text;
}

std::string lower_case(std::string_view word) {
  std::string lower(word);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return lower;
}

std::string_view cut_line(std::string_view& rest) {
  const std::size_t end = count_front(rest, [](char c) { return !is_line_end(c); });
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end);
  rest.remove_prefix(rest.starts_with("\r\n") ? 2 : rest.empty() ? 0 : 1);
  return line;
}

std::string_view next_word(std::string_view& line) {
  const auto between = [](char c) { return is_blank(c) || is_line_end(c); };
  line.remove_prefix(count_front(line, between));
  const std::string_view word = line.substr(0, count_front(line, [&](char c) { return !between(c); }));
  line.remove_prefix(word.size());
  return word;
}

void Digits::see(double value) { floats_ = floats_ && double(float(value)) == value; }

void Digits::see(std::string_view number, double value) {
  see(value);
  int significant = 0, decimals = 0;
  bool point = false;
  for (const char c : number) {
    if (c == '.') {
      point = true;
    } else if (c == 'e' || c == 'E') {
      powers_ = true;
      break;
    } else if (c >= '0' && c <= '9') {
      significant += significant > 0 || c != '0';
      decimals += point;
    }
  }
  most_ = std::max(most_, significant);
  decimals_ = std::max(decimals_, decimals);
  fewest_decimals_ = fewest_decimals_ < 0 ? decimals : std::min(fewest_decimals_, decimals);
}

double Digits::weld(double largest) const {
  constexpr int usual = 6, of_float = 9, of_double = 17;
  constexpr int float_bits = std::numeric_limits<float>::digits, bits = std::numeric_limits<double>::digits;
  if (!(largest > 0)) return 0;
  if (floats_) return weld_of_binary(largest, float_bits);
  if (decimals_ < 0) return weld_of_binary(largest, bits);
  if (decimals_ == 0 && !powers_) return 0;
  const bool fixed = !powers_ && fewest_decimals_ == decimals_;
  const double before_point = std::floor(std::log10(largest)) + 1;
  const double unit = std::pow(10, fixed ? -decimals_ : before_point - std::clamp(most_, usual, of_double));
  const double weld = 1.8 * std::min(unit, 1e-4 * largest);  // sqrt(3), and the round-off of reading them
  return std::max(weld, weld_of_binary(largest, most_ > of_float ? bits : float_bits));
}

double weld_of_binary(double largest, int bits) {
  return largest > 0 ? 4 * std::ldexp(1, std::ilogb(largest) + 1 - bits) : 0;
}

double largest_coordinate(const TriangleMesh& mesh) {
  double largest = 0;
  for (const Vec3& v : mesh.vertices) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  return largest;
}

void Words::skip_blanks_and_comment() {
  rest_.remove_prefix(count_front(rest_, is_blank));
  if (rest_.starts_with('#')) rest_.remove_prefix(count_front(rest_, [](char c) { return !is_line_end(c); }));
}

std::string_view Words::next_in_line() {
  skip_blanks_and_comment();
  const auto of_word = [](char c) { return !is_blank(c) && !is_line_end(c) && c != '#'; };
  const std::string_view word = rest_.substr(0, count_front(rest_, of_word));
  rest_.remove_prefix(word.size());
  if (!word.empty()) at_ = line_;
  return word;
}

std::string_view Words::next() {
  for (;;) {
    const std::string_view word = next_in_line();
    if (!word.empty() || rest_.empty()) return word;
    stop_here();
    (void)cut_line(rest_);
    ++line_;
  }
}

void Words::skip_line() {
  if (line_ != at_) return;
  (void)cut_line(rest_);
  ++line_;
}

bool Words::ended() const {
  Words probe = *this;
  return probe.next().empty();
}

Vec3 Words::point(std::size_t index, Digits& digits, bool in_line) {
  Vec3 p;
  for (int a = 0; a < 3; ++a) {
    const std::string_view word = in_line && a > 0 ? next_in_line() : next();
    const auto value = parse<double>(word);
    if (!value)
      throw error(
          fmt::format("coordinate '{}' of vertex {}, expected three finite numbers", shown(word), index));
    digits.see(word, *value);
    p[a] = *value;
  }
  return p;
}

InputError Words::error(std::string_view what) const {
  return InputError(fmt::format("{}: line {}: {}", *name_, at_, what));
}

}  // namespace kreisel::core
