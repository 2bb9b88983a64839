#include "nest/search/placement_objective.hpp"

#include <algorithm>
#include <limits>

namespace kreisel::core::nest {
namespace {
constexpr double not_placed = -std::numeric_limits<double>::infinity();
}

PlacementObjective::Asked PlacementObjective::allowed(std::span<const double> positions,
                                                      std::size_t count) const {
  const auto size = static_cast<std::size_t>(space().size());
  Asked asked;
  for (std::size_t i = 0; i < count; ++i) {
    Placement placement = placements_.placement(positions.subspan(i * size, size));
    if (keep_outs_.touched(placement.cut)) continue;
    asked.placements.push_back(placement);
    asked.index.push_back(i);
  }
  return asked;
}

std::vector<double> ScaleInPosition::values(std::span<const double> positions,
                                            std::span<const double> floors) {
  std::vector<double> values(floors.size(), not_placed);
  // A copy of no size is none, and no feasibility test takes it.
  Asked worth;
  const Asked asked = allowed(positions, floors.size());
  for (std::size_t k = 0; k < asked.index.size(); ++k)
    if (asked.placements[k].pose.scale > 0) {
      worth.placements.push_back(asked.placements[k]);
      worth.index.push_back(asked.index[k]);
    }
  const std::vector<Verdict> verdicts = feasibility_->check(worth.placements);
  for (std::size_t k = 0; k < verdicts.size(); ++k)
    if (verdicts[k].valid()) values[worth.index[k]] = worth.placements[k].pose.scale;
  return values;
}

std::vector<double> LargestScale::values(std::span<const double> positions, std::span<const double> floors) {
  std::vector<double> values(floors.size(), not_placed);
  const Asked asked = allowed(positions, floors.size());
  std::vector<SearchLimits> limits;
  for (const std::size_t i : asked.index)
    limits.push_back({upper_, abort_ ? std::max(floors[i], 0.0) : 0.0, tolerance_});
  const std::vector<FoundScale> found = search_->search(asked.placements, limits);
  for (std::size_t k = 0; k < found.size(); ++k) {
    tests_ += static_cast<std::uint64_t>(found[k].tests);
    if (found[k].aborted) {
      ++aborted_;
      values[asked.index[k]] = floors[asked.index[k]];
    } else if (found[k].scale > 0) {
      values[asked.index[k]] = found[k].scale;
    }
  }
  return values;
}

}  // namespace kreisel::core::nest
