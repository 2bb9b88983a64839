#include "print/gcode/machine.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "error.hpp"
#include "print/gcode/numbers.hpp"

namespace kreisel::core {
namespace {

constexpr double farthest = 1e6;         // mm: of no printer
constexpr double most_filament = 1e9;    // mm: a thousand kilometres
constexpr double least_filament = 1e-9;  // mm: what adding up differences leaves
constexpr double millimetres_of_inch = 25.4;

bool ends_word(const char* at, const char* end) {
  return at == end || *at == ' ' || *at == '\t' || *at == '\r' || *at == '*' || *at == '(';
}

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

}  // namespace

/// Letters with numbers, "X10.5 E.2".
struct Machine::Words {
  static constexpr std::string_view letters = "XYZEIJRPDS";
  enum Letter { x, y, z, e, i, j, r, p, d, s };
  std::array<double, 10> value{};
  unsigned given = 0;

  /// @param bare  the number that a letter alone stands for; NaN: none does
  explicit Words(std::string_view text, double bare = std::numeric_limits<double>::quiet_NaN()) {
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at != end) {
      char c = *at++;
      if (c == ' ' || c == '\t' || c == '\r') continue;
      if (c == '*') return;  // a checksum
      if (c == '(') {        // a remark
        while (at != end && *at != ')') ++at;
        if (at != end) ++at;
        continue;
      }
      const char* const word = at - 1;
      if (c >= 'a' && c <= 'z') c = char(c - 32);
      if (!(c >= 'A' && c <= 'Z')) throw InputError(refused(word, end));
      double number = number_at(at, end);
      if (at == word + 1 && ends_word(at, end)) number = bare;
      if (std::isnan(number) || !(ends_word(at, end) || is_letter(*at))) throw InputError(refused(word, end));
      const std::size_t slot = slots[std::size_t(c - 'A')];
      if (slot == letters.size()) continue;
      value[slot] = number;
      given |= 1u << slot;
    }
  }
  [[nodiscard]] bool has(Letter letter) const { return (given >> letter & 1u) != 0; }

 private:
  static constexpr std::array<std::size_t, 26> slots = [] {
    std::array<std::size_t, 26> all{};
    for (std::size_t c = 0; c < all.size(); ++c) {
      all[c] = letters.size();
      for (std::size_t k = 0; k < letters.size(); ++k)
        if (letters[k] == char('A' + c)) all[c] = k;
    }
    return all;
  }();
  /// The word that is none, without what a terminal could take for a command.
  static std::string refused(const char* word, const char* end) {
    std::string shown;
    for (; word != end && *word != ' ' && shown.size() < 24; ++word)
      shown += *word >= ' ' && *word <= '~' ? *word : '?';
    return fmt::format("'{}', expected a letter and a number", shown);
  }
};

Laid Machine::run(std::string_view command) {
  const char* at = command.data();
  const char* const end = at + command.size();
  const auto skip_blanks = [&] {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
  };
  skip_blanks();
  if (at != end && *at == 'N') {  // a line's number
    const char* const number = ++at;
    (void)number_at(at, end);
    if (at == number) return {};
    skip_blanks();
  }
  if (at == end) return {};
  char letter = *at++;
  if (letter >= 'a' && letter <= 'z') letter = char(letter - 32);
  if (letter != 'G' && letter != 'M' && letter != 'T') return {};
  const char* const digits = at;
  const double number = number_at(at, end);
  // Others than these: macros of a firmware, "MOVE_TO_TRAY"; and G2.1, which is no arc.
  if (at == digits || !(number >= 0 && number < 1e6) || number != std::floor(number)) return {};
  const int code = int(number);
  const std::string_view rest(at, std::size_t(end - at));
  if (letter == 'T') {
    if (code >= most_tools) return {};  // of a printer's own, T255
    tool_ = code;
    if (retracted_.size() <= std::size_t(code)) retracted_.resize(std::size_t(code) + 1, 0);
    return {};
  }
  if (letter == 'M') {
    if (code == 82) e_relative_ = false;
    if (code == 83) e_relative_ = true;
    if (code == 200) {
      const Words words(rest, 1);
      if (words.has(Words::d)) volumetric_ = words.value[Words::d] > 0;
      if (words.has(Words::s)) volumetric_ = words.value[Words::s] > 0;
    }
    return {};
  }
  switch (code) {
    case 0:
    case 1:
    case 2:
    case 3:
      return move(code, Words(rest));
    case 5:
      if (Words(rest).has(Words::e)) throw InputError("G5, expected straight moves (G1) and arcs (G2, G3)");
      break;
    case 17:
      flat_ = true;
      break;
    case 18:
    case 19:
      flat_ = false;
      break;
    case 20:
      unit_ = millimetres_of_inch;
      break;
    case 21:
      unit_ = 1;
      break;
    case 28: {
      const Words words(rest, 0);
      const bool all = (words.given & 7u) == 0;
      for (int a = 0; a < 3; ++a)
        if (all || words.has(Words::Letter(a))) at_[a] = shift_[a] = 0;
      break;
    }
    case 90:
      relative_ = false;
      break;
    case 91:
      relative_ = true;
      break;
    case 92:
      set_position(Words(rest, 0));
      break;
    default:
      break;
  }
  return {};
}

void Machine::set_position(const Words& words) {
  const bool all = words.given == 0;
  for (int a = 0; a < 3; ++a)
    if (all || words.has(Words::Letter(a))) shift_[a] = at_[a] - unit_ * words.value[std::size_t(a)];
  if (all || words.has(Words::e)) e_ = unit_ * words.value[Words::e];
}

double Machine::extruded(double value) {
  const double out = e_relative_ || relative_ ? value : value - e_;
  e_ += out;
  if (!(std::abs(e_) < most_filament))
    throw InputError(fmt::format("E{:.6g}, expected less than {:.0g} mm of filament", value, most_filament));
  double& retracted = retracted_[std::size_t(tool_)];
  if (out < 0) {
    retracted -= out;
    return 0;
  }
  const double back = std::min(out, retracted);
  retracted -= back;
  return out - back > least_filament ? out - back : 0;
}

Laid Machine::move(int code, const Words& words) {
  Laid laid;
  laid.from = at_;
  for (int a = 0; a < 3; ++a) {
    if (!words.has(Words::Letter(a))) continue;
    const double value = unit_ * words.value[std::size_t(a)];
    if (!(std::abs(value) < farthest))
      throw InputError(fmt::format("{}{:.6g}, expected less than {:.0g} mm", "XYZ"[a], value, farthest));
    at_[a] = relative_ ? at_[a] + value : value + shift_[a];
  }
  laid.to = at_;
  if (words.has(Words::e)) laid.filament = extruded(unit_ * words.value[Words::e]);
  if (!(laid.filament > 0)) return laid;
  laid.stands = laid.from[0] == laid.to[0] && laid.from[1] == laid.to[1];
  if (code >= 2) turn(laid, code, words);
  return laid;
}

void Machine::turn(Laid& laid, int code, const Words& words) const {
  if (!flat_)
    throw InputError("an arc in a plane that stands (G18, G19), expected one in that of the bed (G17)");
  const double way = code == 3 ? 1 : -1;  // counter-clockwise
  const Eigen::Vector2d from = laid.from.head<2>(), to = laid.to.head<2>(), chord = to - from;
  Eigen::Vector2d centre = from;
  if (words.has(Words::r)) {
    const double r = unit_ * words.value[Words::r], half = 0.5 * chord.norm();
    if (!(half > 0)) throw InputError("an arc by R that ends where it begins, expected one by I and J");
    if (half > 1.001 * std::abs(r))
      throw InputError(
          fmt::format("an arc of radius {:.6g} mm between points {:.6g} mm apart, expected them no "
                      "farther apart than twice the radius",
                      std::abs(r), 2 * half));
    const double height = std::sqrt(std::max(0.0, r * r - half * half));
    // The shorter way round, or the longer one with a negative radius.
    centre = from + 0.5 * chord +
             (r > 0 ? way : -way) * height / (2 * half) * Eigen::Vector2d(-chord[1], chord[0]);
  } else if (words.has(Words::i) || words.has(Words::j)) {
    centre += unit_ * Eigen::Vector2d(words.value[Words::i], words.value[Words::j]);
  } else {
    throw InputError("an arc without its centre, expected I and J, or R");
  }
  const Eigen::Vector2d begins = from - centre, ends = to - centre;
  const double r = begins.norm();
  if (!(r > 0) || std::abs(ends.norm() - r) > 0.1 + 0.01 * r)
    throw InputError(
        fmt::format("an arc that begins {:.6g} mm from its centre and ends {:.6g} mm from it, expected "
                    "the same",
                    r, ends.norm()));
  constexpr double full = 2 * std::numbers::pi, straight = 1e-4;
  double angle = way * (std::atan2(ends[1], ends[0]) - std::atan2(begins[1], begins[0]));
  const bool closed = !(chord.norm() > 0);  // a whole turn
  while (closed ? angle <= 0 : angle < -1e-9) angle += full;
  if (words.has(Words::p))
    angle += full * std::max(0.0, std::round(words.value[Words::p]) - (closed ? 1 : 0));
  if (angle < straight) return;
  laid.centre << centre, laid.from[2];
  laid.angle = way * angle;
  laid.stands = false;
}

}  // namespace kreisel::core
