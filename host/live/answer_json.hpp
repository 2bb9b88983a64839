// answer_json.hpp - a question answered, as JSON. [docs/live.md]
#pragma once

#include <nlohmann/json.hpp>

#include "session/solved_run.hpp"

namespace kreisel::core::live {

/// Numbers of the solid and, where there is an interior, of the part; and the ten coefficients that cut it.
[[nodiscard]] nlohmann::json answer_json(const SolvedRun& run);

/// How far the answer may be from the best there is.
[[nodiscard]] nlohmann::json certificate_json(const RunResult& result);

}  // namespace kreisel::core::live
