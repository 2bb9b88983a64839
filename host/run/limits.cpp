#include "run/limits.hpp"

#include <fmt/format.h>

namespace kreisel::core {

std::string memory_limit_text(const Limits& limits) {
  return fmt::format("more than {:g} GB", limits.gigabytes);
}
std::string time_limit_text(const Limits& limits) { return fmt::format("more than {:g} s", limits.seconds); }

bool is_limit(const Limits& limits, const std::string& error) {
  return (limits.gigabytes > 0 && error == memory_limit_text(limits)) ||
         (limits.seconds > 0 && error == time_limit_text(limits));
}

}  // namespace kreisel::core
