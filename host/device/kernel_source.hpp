// kernel_source.hpp - the OpenCL sources that the build embedded.
#pragma once

#include <string_view>
#include <vector>

namespace kreisel::core::device {

struct KernelSource {
  std::string_view stem;  ///< file name without .cl
  std::string_view text;  ///< includes already inlined
};

/// Every kernels/*.cl, sorted by stem.
const std::vector<KernelSource>& kernel_sources();

}  // namespace kreisel::core::device
