// read_off.hpp - the OFF format.
#pragma once

#include "mesh/io/mesh_text.hpp"

namespace kreisel::core {

/// A text OFF file; colours, normals and texture coordinates (COFF, NOFF, STOFF) are passed over.
/// @throws InputError  one line with file, line, what and what was expected
[[nodiscard]] TriangleMesh read_off(const MeshFile& file);

}  // namespace kreisel::core
