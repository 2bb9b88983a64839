// run_text.hpp - how lists, progress and tables name a run.
#pragma once

#include <string>

#include "experiment/experiment.hpp"
#include "session/config.hpp"

namespace kreisel::core {

/// "80x52x51", or "64" when only the longest side is given.
[[nodiscard]] std::string grid_text(const GridSpec& grid);

/// "ellipsoid 80x52x51 voxel ipopt", "bunny 100 spin map through centre"; a mesh file by its stem.
[[nodiscard]] std::string run_text(const RunConfig& config);

/// The same of any run; "bunny in bunny hybrid+abort all seed 3" of a nesting.
[[nodiscard]] std::string run_text(const ExperimentRun& run);

/// The stem of a mesh file, or the name of a model.
[[nodiscard]] std::string model_text(const RunConfig& config);

}  // namespace kreisel::core
