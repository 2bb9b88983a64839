// encode.hpp - meshes as the bytes of a file.
#pragma once

#include <string>
#include <vector>

#include "mesh/io/mesh_object.hpp"

namespace kreisel::core {

/// All parts as one file; `name` is what errors call it.
/// @throws InputError  a coordinate that is not finite, or what the format cannot hold
/// Binary STL: single precision; a triangle without area has a zero normal.
[[nodiscard]] std::string encode_stl(const std::vector<TriangleMesh>& parts, const std::string& name);
/// One object in millimetres, so that an inner part is a cavity of the outer; single precision, with all its
/// digits. What is far from the origin is written about a place near it, to which the transform of its build
/// item takes it.
[[nodiscard]] std::string encode_3mf(const std::vector<TriangleMesh>& parts, const std::string& name);
/// An object each, all of them to be built where they are.
[[nodiscard]] std::string encode_3mf_objects(const std::vector<MeshObject>& objects, const std::string& name);
/// Text with the fewest digits that give back the same doubles.
[[nodiscard]] std::string encode_obj(const std::vector<TriangleMesh>& parts, const std::string& name);
[[nodiscard]] std::string encode_off(const std::vector<TriangleMesh>& parts, const std::string& name);
/// Binary, little-endian, coordinates in double.
[[nodiscard]] std::string encode_ply(const std::vector<TriangleMesh>& parts, const std::string& name);

/// The parts one after the other as one mesh. @throws InputError  more than 2^32 - 1 vertices or triangles
[[nodiscard]] TriangleMesh joined(const std::vector<TriangleMesh>& parts, const std::string& name);

/// @throws InputError  the first coordinate whose size is not at most `limit`, or is no number
void require_coordinates_within(double limit, std::string_view expected, const TriangleMesh& mesh,
                                const std::string& name);

}  // namespace kreisel::core
