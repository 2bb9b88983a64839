// read_3mf.hpp - the 3MF format.
#pragma once

#include <vector>

#include "mesh/io/mesh_file.hpp"
#include "mesh/io/mesh_reading.hpp"

namespace kreisel::core {

/// All that a 3MF package builds, as one mesh in millimetres: the meshes of every build item, through its
/// components, with their transforms and the units of their files applied. A mirroring transform keeps
/// triangles outward. Colours and materials are passed over. What is no material is left out, and a note says
/// so: objects of another type than `model`, items that are not to be printed, and what slicers use as
/// modifiers, support blockers and enforcers.
/// @throws InputError  one line: no package, a broken one, a triangle that names no vertex, nothing to build,
///                     a negative volume, a required extension that is not read
[[nodiscard]] MeshReading read_3mf(const MeshFile& file);

/// The same, a mesh for each build item that is material, in their order.
[[nodiscard]] std::vector<TriangleMesh> read_3mf_objects(const MeshFile& file);

}  // namespace kreisel::core
