#include "session/mending_fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "parse.hpp"
#include "settings/field_text.hpp"

namespace kreisel::core {
using namespace field_text;
namespace {

using S = std::string_view;

const std::vector<S> ways_inside_out = {"solid", "void"};

std::optional<double> holes(S key, S value) {
  if (value == "all") return std::numeric_limits<double>::infinity();
  if (!parse<double>(value)) refuse(key, value, "mm, or all");
  const double across = number(key, value);
  if (across <= 0) refuse(key, value, "more than 0 mm");
  return across;
}

std::vector<int> pieces(S key, S value) {
  if (value == "largest") return {1};
  std::vector<int> numbers;
  for (const S part : split(value, ',')) {
    const int n = parse<int>(part).value_or(0);
    if (n < 1 || std::ranges::count(numbers, n)) refuse(key, value, "largest, or different numbers from 1");
    numbers.push_back(n);
  }
  return numbers;
}

}  // namespace

Fields<Mending> mending_fields() {
  using M = Mending&;
  using ConstM = const Mending&;
  return grouped<Mending>(
      "mesh",
      {{"weld", "mm",
        "join corners at open edges that are this near; default: what the digits of the file cannot tell "
        "apart",
        [](M m, S k, S v) {
          m.weld = number(k, v);
          if (*m.weld < 0) refuse(k, v, "0 mm or more");
        },
        [](ConstM m) { return number_text(m.weld); }},
       {"close-holes",
        "mm",
        "close holes of the surface that are no larger across; with all, or no value: holes of any size",
        [](M m, S k, S v) { m.close_holes = holes(k, v); },
        [](ConstM m) {
          return m.close_holes && std::isinf(*m.close_holes) ? std::string("all")
                                                             : number_text(m.close_holes);
        },
        Identity::changed,
        1,
        false,
        "",
        {},
        "all"},
       chosen_from<Mending>(
           words_of(ways_inside_out),
           {"inside-out", "", "what a part of the surface that is inside out encloses: solid, or void",
            [](M m, S k, S v) { m.inside_out = InsideOut(1 + word_of(k, v, ways_inside_out)); },
            [](ConstM m) {
              const auto way = std::size_t(m.inside_out);
              return way ? std::string(ways_inside_out[way - 1]) : std::string();
            }}),
       {"pieces", "N,N",
        "which pieces to keep of several that do not touch: numbers by weight (1 is the heaviest), or "
        "largest",
        [](M m, S k, S v) { m.pieces = pieces(k, v); },
        [](ConstM m) { return fmt::format("{}", fmt::join(m.pieces, ",")); }}});
}

}  // namespace kreisel::core
