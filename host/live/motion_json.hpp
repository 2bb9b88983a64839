// motion_json.hpp - a solid and its part in motion, as a page plays it.
#pragma once

#include <nlohmann/json.hpp>

#include "run/simulation.hpp"

namespace kreisel::core::live {

/// @param frame  of the body whose motion it is
[[nodiscard]] nlohmann::json motion_json(const Simulation& simulation, const Frame& frame);

}  // namespace kreisel::core::live
