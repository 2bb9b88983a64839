// write_stl.hpp - triangle meshes into one binary STL file.
#pragma once

#include <filesystem>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace kreisel {

/// All parts into one binary STL file, coordinates rounded to float as the format wants; lengths are taken to
/// be millimetres. A triangle without area gets a zero normal. The file appears whole or not at all: it is
/// written under a temporary name beside `path`, which it then replaces.
/// @throws InputError  the folder is absent or not writable, the disk is full, a coordinate is outside float,
///                     or more than 2^32 - 1 triangles
void write_stl(const std::filesystem::path& path, const std::vector<TriangleMesh>& parts);

}  // namespace kreisel
