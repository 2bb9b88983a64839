// write.hpp - triangle meshes into one file.
#pragma once

#include <filesystem>
#include <vector>

#include "mesh/io/mesh_object.hpp"

namespace kreisel::core {

/// All parts (the outer surface and its cavities, say) into one file, whose format follows from the
/// extension: .stl (binary), .3mf (one object, unit millimetre), .obj, .ply (binary), .off. Lengths are taken
/// to be millimetres. OBJ, PLY and OFF keep every digit, STL and 3MF round coordinates to single precision.
/// Creates the folder; the file appears whole or not at all.
/// @throws InputError  another extension, not writable, the disk is full, a coordinate outside the format's
///                     range, or more triangles than it can count
void write_mesh(const std::filesystem::path& path, const std::vector<TriangleMesh>& parts);

/// Several objects into one file of a format that has objects (3MF). @throws InputError  as above
void write_objects(const std::filesystem::path& path, const std::vector<MeshObject>& objects);

}  // namespace kreisel::core
