// read.hpp - triangle meshes from files.
#pragma once

#include <filesystem>

#include "mesh/io/mesh_reading.hpp"

namespace kreisel::core {

/// The triangles of an STL (binary or text), 3MF, OBJ, PLY or OFF file. 3MF knows its unit and comes in
/// millimetres, the others in the file's own length unit. The format follows from the extension in any case.
/// Polygons with more than three corners are cut into triangles within their outline (polygons.hpp). Nothing
/// is repaired: duplicates, holes and unused vertices arrive as they stand in the file, repaired() and
/// require_solid() see to them. STL has no shared corners; there, equal coordinates become one vertex.
/// @throws InputError  missing, a directory, unknown extension, empty, cut off, an index outside the
///                     vertices, a coordinate that is no finite number, or no triangle at all
[[nodiscard]] MeshReading read_mesh_file(const std::filesystem::path& path);

/// Its mesh alone.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path);

/// The same, a mesh for each object of a format that has objects (3MF); one of others.
[[nodiscard]] std::vector<TriangleMesh> read_objects(const std::filesystem::path& path);

}  // namespace kreisel::core
