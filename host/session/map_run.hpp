// map_run.hpp - a map of orientations as a run. [docs/map.md]
#pragma once

#include "session/config.hpp"

namespace kreisel::core {

/// Every orientation instead of one: no part is made, and nothing is timed.
struct MapRun : Asked {
  MapRun();
  /// The same question, asked of all orientations. @throws InputError  by a formulation that has no map
  explicit MapRun(Asked asked);

  int axes = 2000;  ///< directions of the sphere
  Through through = Through::lowest;
  std::vector<std::string> drafts;  ///< of what has cases (MapCases): values of that setting
};

/// What answers for each orientation.
inline constexpr std::string_view map_solver = "moment";

[[nodiscard]] const Fields<MapRun>& map_fields();
void set_field(MapRun& map, std::string_view key, std::string_view value);
[[nodiscard]] std::map<std::string, std::string> describe(const MapRun& map);
/// "bunny-100-spin-map-1a2b3c4d"
[[nodiscard]] std::string run_name(const MapRun& map);

}  // namespace kreisel::core
