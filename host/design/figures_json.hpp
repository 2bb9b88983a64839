// figures_json.hpp - the numbers of a solid as JSON.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

#include "design/figures.hpp"

namespace kreisel::core {

/// What is not finite is null.
[[nodiscard]] inline nlohmann::json json_number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

[[nodiscard]] nlohmann::json json_of(const Figures& figures);

}  // namespace kreisel::core
