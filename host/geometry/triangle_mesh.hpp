// triangle_mesh.hpp - an indexed triangle mesh, nothing more.
#pragma once

#include "geometry/box.hpp"
#include "kreisel/mesh.hpp"

namespace kreisel::core {

using kreisel::Triangle;
using kreisel::Vec3;
using TriangleMesh = kreisel::Mesh;

/// Box of all vertices.
[[nodiscard]] inline Box bounding_box(const TriangleMesh& mesh) { return bounding_box(mesh.vertices); }

}  // namespace kreisel::core
