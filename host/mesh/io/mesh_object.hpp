// mesh_object.hpp - meshes that make one thing with a name.
#pragma once

#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Its outer surface and its cavities, say.
struct MeshObject {
  std::string name;
  std::vector<TriangleMesh> parts;
};

}  // namespace kreisel::core
