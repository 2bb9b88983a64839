// placement_search.hpp - the largest nesting there is to be found: a swarm, then a climb from its best.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "nest/search/climb.hpp"
#include "nest/search/placement_objective.hpp"
#include "nest/search/swarm.hpp"

namespace kreisel::core::nest {

/// All there is to know of a search on its way; one that goes on from a copy ends as the other does.
struct SearchState {
  enum Phase { swarming, climbing, over } phase = swarming;
  SwarmState swarm;
  ClimbState climb;
  int climbs = 0;                ///< begun
  std::vector<SwarmStep> trace;  ///< every iteration, the climbs' counted on from the swarm's
  std::vector<double> best;      ///< position; empty while nothing nests
  double scale = 0;              ///< of the best
  std::vector<Vec3> memory;      ///< what the scale search has learned: answers may differ by it, if little

  [[nodiscard]] std::uint64_t evaluations() const { return trace.empty() ? 0 : trace.back().evaluations; }
};

struct PlacementSearchOptions {
  SwarmOptions swarm;
  ClimbOptions climb;  ///< seeded by the swarm's seed
  int climbs = 1;      ///< from the best positions of different particles, best first; 0: none, the paper's
};

/// Swarm and climbs over one objective, a step at a time.
class PlacementSearch {
 public:
  /// @throws InputError  invalid options
  PlacementSearch(PlacementObjective& objective, const PlacementSearchOptions& options);

  [[nodiscard]] SearchState start() const;
  /// One iteration of the swarm or of a climb. @return  whether there is more to do
  bool step(SearchState& state) const;
  /// Lets another search's position replace the worst of the swarm's, if it is better; passed over where it
  /// is no position of this space, or the swarm has come to its end.
  void take_in(SearchState& state, const std::vector<double>& x) const;

  /// The best so far. Its scale is state.scale. @pre  state.best is not empty
  [[nodiscard]] Placement best(const SearchState& state) const;

 private:
  void begin_climb(SearchState& state) const;
  void keep(SearchState& state, const SwarmStep& step, const std::vector<double>& x, double value) const;

  PlacementObjective& objective_;
  PlacementSearchOptions options_;
  Swarm swarm_;
  Climb climb_;
};

}  // namespace kreisel::core::nest
