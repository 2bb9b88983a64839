// run_design.hpp - `design` as a user runs it.
#pragma once

#include "apps/run_bench.hpp"

namespace kreisel::core {

inline BenchAnswer design(const std::string& arguments, const std::string& before = "") {
  return shell(fmt::format("{} '{}' {}", before, KREISEL_DESIGN, arguments));
}

}  // namespace kreisel::core
