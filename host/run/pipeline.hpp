// pipeline.hpp - one run from the configuration to the verified part.
#pragma once

#include <functional>
#include <string>

#include "mesh/triangle_mesh.hpp"
#include "run/result.hpp"

namespace kreisel {

/// Told what is under way, for progress on a terminal. May be empty.
using Progress = std::function<void(const std::string& step)>;

struct RunOutput {
  RunResult result;
  /// Of the part, and of its voids: model coordinates, mm. No cavity where part = none.
  TriangleMesh outer, cavity;
};

/// Body -> domain -> formulation -> solver (repeated) -> round -> void surface -> written file -> verdict;
/// with part = none it ends after the solver.
///
/// @param mesh_file  where the part is written (STL, replaced as a whole); empty: a temporary file, removed
/// @throws InputError   bad configuration or mesh; a mesh_file with part = none
/// @throws Interrupted  before there was a result; nothing is written
/// @throws MemoryError  the solver has too little
RunOutput run(const RunConfig& config, const std::string& mesh_file = {}, const Progress& progress = {});

}  // namespace kreisel
