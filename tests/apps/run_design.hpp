// run_design.hpp - `design` as a user runs it.
#pragma once

#include "apps/run_bench.hpp"
#include "places.hpp"

namespace kreisel::core {

inline BenchAnswer design(const std::string& arguments, const std::string& before = "") {
  return shell(fmt::format("{} '{}' {}", before, design_program, arguments));
}

}  // namespace kreisel::core
