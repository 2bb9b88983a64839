// step_line.hpp - what is under way, on a terminal.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "apps/shared/program.hpp"
#include "control.hpp"

namespace kreisel::core::apps {

/// The step under way, on a terminal; the line is taken back in the end, also ahead of an error.
class StepLine {
 public:
  StepLine() = default;
  StepLine(const StepLine&) = delete;
  StepLine& operator=(const StepLine&) = delete;
  ~StepLine() {
    if (terminal_) fmt::print(stderr, "\r\033[K");
  }
  /// For work that the user may stop. @pre  outlives it
  [[nodiscard]] Control control() const {
    return {interruption(), [this](const std::string& step) { show(step); }};
  }
  void show(const std::string& step) const {
    if (terminal_) fmt::print(stderr, "\r\033[K{} ...", step);
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) != 0;
};

}  // namespace kreisel::core::apps
