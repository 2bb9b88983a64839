#include "session/ranges.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace kreisel::core {

std::optional<Range> range_of(std::string_view field) {
  using Entry = std::pair<std::string_view, Range>;
  constexpr Range mm{0.5, 10}, density{0.05, 20};
  static constexpr std::array all = {Entry{"size", {20, 200}},
                                     Entry{"wall", {0.4, 10}},
                                     Entry{"density", density},
                                     Entry{"interior-density", density},
                                     Entry{"void-density", {0, 20}},
                                     Entry{"stem", mm},
                                     Entry{"flatten", mm},
                                     Entry{"axle", mm},
                                     Entry{"slot", mm},
                                     Entry{"axle-depth", {1, 30}},
                                     Entry{"problem.draft", {5, 95, "%"}},
                                     Entry{"problem.fluid_density", {0.5, 14}},
                                     Entry{"problem.margin", mm},
                                     Entry{"problem.base", {0, 20}}};
  const auto found = std::ranges::find(all, field, &Entry::first);
  if (found == all.end()) return {};
  return found->second;
}

}  // namespace kreisel::core
