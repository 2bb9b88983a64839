// pocl_cache.hpp - the folder without which PoCL finds no device, or builds no kernel, and says nothing of
// it.
#pragma once

#include <string>
#include <string_view>

namespace kreisel::core::device {

/// What PoCL calls its platform.
inline constexpr std::string_view pocl = "Portable Computing Language";

/// What is wrong with the folder that PoCL keeps its kernels in: "POCL_CACHE_DIR = /x cannot be made;
/// expected ..."; empty where kernels can be written.
[[nodiscard]] std::string trouble_with_pocl_cache();

/// An empty POCL_CACHE_DIR, on which PoCL ends the program, is as none.
void pass_over_empty_pocl_cache();

}  // namespace kreisel::core::device
