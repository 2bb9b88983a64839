#include "nest/decide/scale_search.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "error.hpp"
#include "nest/decide/bisection.hpp"
#include "nest/decide/hybrid.hpp"

namespace kreisel::core::nest {

void require_valid(const SearchLimits& limits) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  if (!positive(limits.upper))
    throw InputError(fmt::format("upper bound {:.6g} of the scale; expected a number > 0", limits.upper));
  if (!positive(limits.tolerance))
    throw InputError(fmt::format("tolerance {:.6g} of the scale; expected a number > 0", limits.tolerance));
  if (!(limits.abort_below >= 0))
    throw InputError(fmt::format("abort_below {:.6g}; expected a scale >= 0", limits.abort_below));
}

std::vector<FoundScale> ScaleSearch::search(std::span<const Placement> placements,
                                            std::span<const SearchLimits> limits) {
  if (placements.size() != limits.size())
    throw std::invalid_argument(fmt::format("{} limits for {} placements", limits.size(), placements.size()));
  std::vector<FoundScale> found;
  for (std::size_t i = 0; i < placements.size(); ++i) found.push_back(search(placements[i], limits[i]));
  return found;
}

std::unique_ptr<ScaleSearch> make_search(std::string_view name, device::Device& device,
                                         const Nesting& nesting, int resolution) {
  if (name == "hybrid") return std::make_unique<Hybrid>(nesting);
  return std::make_unique<Bisection>(make_feasibility(name, device, nesting, resolution));
}

}  // namespace kreisel::core::nest
