// ranges.hpp - what a hand may well move a field's number over.
#pragma once

#include <optional>
#include <string_view>

namespace kreisel::core {

/// As bodies are that people hold in their hands; no limits.
struct Range {
  double low, high;
  std::string_view suffix = "";  ///< behind the number in the field's text: "%"
};

/// @param field  by its name; nothing: it is no number, or nobody moves it
[[nodiscard]] std::optional<Range> range_of(std::string_view field);

}  // namespace kreisel::core
