// read_obj.hpp - the OBJ format.
#pragma once

#include "mesh/io/mesh_text.hpp"

namespace kreisel::core {

/// Vertices and faces of an OBJ file; everything else in it (normals, groups, materials, lines) is passed
/// over.
/// @throws InputError  one line with file, place, what and what was expected
[[nodiscard]] TriangleMesh read_obj(const MeshFile& file);

}  // namespace kreisel::core
