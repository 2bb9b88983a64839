// mesh_object.hpp - meshes that make one thing with a name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Its outer surface and its cavities, say.
struct MeshObject {
  std::string name;
  std::vector<TriangleMesh> parts;
  /// What coordinates are written about in a format with such a place; default: place_of() them.
  std::optional<Vec3> place = {};
};

}  // namespace kreisel::core
