// absent_files.hpp - mesh files that an experiment names and that whoever runs it may not have.
#pragma once

#include <string>

#include "experiment/experiment.hpp"

namespace kreisel::core {

/// Which mesh files of a run are not here, and where they were looked for: "no falcon.obj in the current
/// folder nor in models; --models names another". Empty where all are there. Whether one can be read is seen
/// when it is.
[[nodiscard]] std::string text_of_absent(const ExperimentRun& run);

}  // namespace kreisel::core
