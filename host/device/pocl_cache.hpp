// pocl_cache.hpp - the folder without which PoCL finds no device, or builds no kernel, and says nothing of
// it.
#pragma once

#include <string>

namespace kreisel::core::device {

/// What is wrong with the folder that PoCL keeps its kernels in: "POCL_CACHE_DIR = /x cannot be made;
/// expected
/// ..."; empty where it can be written.
[[nodiscard]] std::string trouble_with_pocl_cache();

}  // namespace kreisel::core::device
