// other_axes.hpp - about which axes a body can spin that cannot about the one that was asked for.
#pragma once

#include <string>

#include "session/solved_run.hpp"

namespace kreisel::core {

/// Of five hundred axes through the lowest point along each, on a coarse grid: how many will do, the one
/// nearest to the configuration's and the best, as options of a command line. [docs/map.md]
/// @param asked  the axis that will not, model coordinates
[[nodiscard]] std::string other_axes(Session& session, const RunConfig& config, const Vec3& asked,
                                     const Control& control);

}  // namespace kreisel::core
