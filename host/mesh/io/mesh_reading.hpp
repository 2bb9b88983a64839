// mesh_reading.hpp - what a file says of a mesh.
#pragma once

#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A mesh as its file has it, in the file's order.
struct MeshReading {
  TriangleMesh mesh;
  double weld = 0;                 ///< what the file's digits cannot tell apart, in units of the mesh
  std::vector<std::string> notes;  ///< what was passed over, one line each
};

}  // namespace kreisel::core
