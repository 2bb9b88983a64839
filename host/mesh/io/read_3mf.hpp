// read_3mf.hpp - the 3MF format.
#pragma once

#include "mesh/io/mesh_text.hpp"

namespace kreisel::core {

/// All that a 3MF package builds, as one mesh in millimetres: the meshes of every build item, through its
/// components, with their transforms and the unit of the file applied. Objects of the types support and
/// solidsupport are not part of the shape and passed over; a mirroring transform keeps triangles outward.
/// The format's library reads coordinates in single precision.
/// @throws InputError  one line: no package, a broken one, a triangle that names no vertex, nothing to build
[[nodiscard]] TriangleMesh read_3mf(const MeshFile& file);

/// The same, a mesh for each build item, in their order.
[[nodiscard]] std::vector<TriangleMesh> read_3mf_objects(const MeshFile& file);

}  // namespace kreisel::core
