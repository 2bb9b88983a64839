// pipeline.hpp - one run from the configuration to the verified part.
#pragma once

#include <string>

#include "geometry/triangle_mesh.hpp"
#include "session/solved_run.hpp"

namespace kreisel::core {

struct RunOutput {
  RunResult result;
  /// Of the part, and of its voids: model coordinates, mm. No cavity where part = none.
  TriangleMesh outer, cavity;
};

/// The optimum (solved_run.hpp), and with part = written the part (make_part.hpp), its file and the verdict.
///
/// @param mesh_file  where the part is written (replaced as a whole); empty: nowhere, and judged as it would
/// be
/// @throws InputError   bad configuration or mesh; a mesh_file with part = none
/// @throws Interrupted  before there was a result; nothing is written
/// @throws MemoryError  the solver has too little
RunOutput run(const RunConfig& config, const std::string& mesh_file = {}, const Control& control = {});

}  // namespace kreisel::core
