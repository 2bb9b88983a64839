// content_key.hpp - a name for whatever a file in a cache was made from.
#pragma once

#include <string>
#include <string_view>

namespace kreisel::core {

/// 32 hexadecimal digits: FNV-1a of 64 bits from two starts. Not against those who want two to be alike.
[[nodiscard]] std::string content_key(std::string_view content);

}  // namespace kreisel::core
