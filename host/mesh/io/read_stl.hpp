// read_stl.hpp - the two STL formats.
#pragma once

#include "mesh/io/mesh_file.hpp"
#include "mesh/io/mesh_reading.hpp"

namespace kreisel::core {

/// A binary or text STL file. Corners whose three coordinates are equal become one vertex, nothing else does.
/// Normals are not read: the order of the corners decides.
/// @throws InputError  one line with file, place, what and what was expected
[[nodiscard]] MeshReading read_stl(const MeshFile& file);

}  // namespace kreisel::core
