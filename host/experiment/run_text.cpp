#include "experiment/run_text.hpp"

#include <fmt/format.h>

namespace kreisel::core {

std::string run_text(const ExperimentRun& run) {
  const bool nesting = std::holds_alternative<NestConfig>(run.run);
  return run_text(run.run) + (nesting && !run.label.empty() ? " " + run.label : "");
}

}  // namespace kreisel::core
