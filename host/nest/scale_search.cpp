#include "nest/scale_search.hpp"

namespace kreisel::nest {

std::vector<FoundScale> ScaleSearch::search(std::span<const Placement> placements,
                                            std::span<const SearchLimits> limits) {
  std::vector<FoundScale> found;
  for (std::size_t i = 0; i < placements.size(); ++i) found.push_back(search(placements[i], limits[i]));
  return found;
}

}  // namespace kreisel::nest
