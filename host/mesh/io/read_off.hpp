// read_off.hpp - the OFF format.
#pragma once

#include "mesh/io/mesh_file.hpp"
#include "mesh/io/mesh_reading.hpp"

namespace kreisel::core {

/// A text OFF file; colours, normals and texture coordinates (COFF, NOFF, STOFF and what these make together)
/// are passed over. Vertices and faces have lines of their own, or run on over any lines; the header may be
/// absent, or end in the first count.
/// @throws InputError  one line with file, line, what and what was expected
[[nodiscard]] MeshReading read_off(const MeshFile& file);

}  // namespace kreisel::core
