// accuracy.hpp - how far are sampled answers from exact ones?
#pragma once

#include <stop_token>
#include <vector>

#include "nest/decide/scale_search.hpp"

namespace kreisel::core::nest {

/// Sampled scales less exact ones over random placements, at one resolution. In units of the scale.
struct SampledError {
  int resolution = 0;
  int optimistic = 0;   ///< sampled above exact by more than the tolerance
  int pessimistic = 0;  ///< below by more
  int missed = 0;       ///< bisection found no valid scale where there is one: feasibility is not monotonic
  double median = 0, most_of = 0, largest = 0;  ///< of those not missed; most_of: 95 %
};

/// What a comparison found.
struct Accuracy {
  int placements = 0;  ///< drawn
  int nested = 0;      ///< of which some scale is valid
  int exact_agrees =
      0;  ///< of those: exact says valid at the hybrid search's scale, and invalid a tolerance above
  int peel_disagrees = 0;  ///< pixels in which peeling and envelopes differ
  long pixels = 0;         ///< compared
  std::vector<SampledError> errors;
};

/// Draws placements (turned anyhow, centroids in the middle half of A's box, oblique cuts and removals) and
/// searches each by `hybrid` and, by bisection, by `envelope` at every resolution; a tenth of them are
/// peeled, too.
/// @param stop  asked before each placement; what was found so far is returned
[[nodiscard]] Accuracy compare(device::Device& device, const Nesting& nesting, int placements,
                               const std::vector<int>& resolutions, std::uint64_t seed,
                               const std::stop_token& stop);

}  // namespace kreisel::core::nest
