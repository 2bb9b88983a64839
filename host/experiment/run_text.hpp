// run_text.hpp - how lists, progress and tables name a run.
#pragma once

#include <string>

#include "experiment/experiment.hpp"

namespace kreisel::core {

/// run_text() of the run, with its label where that tells nestings apart.
[[nodiscard]] std::string run_text(const ExperimentRun& run);

}  // namespace kreisel::core
