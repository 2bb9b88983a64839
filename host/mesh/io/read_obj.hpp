// read_obj.hpp - the OBJ format.
#pragma once

#include "mesh/io/mesh_file.hpp"
#include "mesh/io/mesh_reading.hpp"

namespace kreisel::core {

/// Vertices and faces of an OBJ file. Other statements (groups, materials, lines, curves) are passed over and
/// counted in a note; normals, texture coordinates, colours and weights of vertices are passed over.
/// @throws InputError  one line with file, place, what and what was expected
[[nodiscard]] MeshReading read_obj(const MeshFile& file);

}  // namespace kreisel::core
