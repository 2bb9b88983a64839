// read_ply.hpp - the PLY format.
#pragma once

#include "mesh/io/mesh_file.hpp"
#include "mesh/io/mesh_reading.hpp"

namespace kreisel::core {

/// A PLY file, ascii or binary of either byte order. Read are x, y, z of the element `vertex` and the list
/// `vertex_indices` (or `vertex_index`) of the elements `face` and `tristrips`, in any of PLY's number types;
/// other elements and properties are passed over, whatever their values. The file must end where its header
/// says.
/// @throws InputError  one line with file, place, what and what was expected
[[nodiscard]] MeshReading read_ply(const MeshFile& file);

}  // namespace kreisel::core
