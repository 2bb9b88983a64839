// limits.hpp - why a run was ended, in the words of its record.
#pragma once

#include <string>

#include "session/config.hpp"

namespace kreisel::core {

/// "more than 8 GB", "more than 600 s": why a run was ended, as its record and the tables say it.
[[nodiscard]] std::string memory_limit_text(const Limits& limits);
[[nodiscard]] std::string time_limit_text(const Limits& limits);
/// Is `error` what one of these limits ends a run with? A run that ended so need not be made again.
[[nodiscard]] bool is_limit(const Limits& limits, const std::string& error);

}  // namespace kreisel::core
