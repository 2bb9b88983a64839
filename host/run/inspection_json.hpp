// inspection_json.hpp - what is known of a mesh, as JSON. [docs/output.md]
#pragma once

#include <nlohmann/json.hpp>

#include "session/inspect.hpp"

namespace kreisel::core {

[[nodiscard]] nlohmann::json json_of(const Inspection& seen);

}  // namespace kreisel::core
