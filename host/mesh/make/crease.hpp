// crease.hpp - triangles along the crease in which two smooth pieces of a marched surface meet.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// The piece of surface in a tetrahedron: three or four vertices on its edges, each two neighbours in a face.
using CreasedLoop = std::vector<std::uint32_t>;

/// Fills the loops, whose vertices are of two pieces, with triangles that meet in an edge where the pieces
/// do.
///
/// In a face with a vertex of each piece a third one is placed between them. Where that would lie at the
/// face's rim, or the triangles of a tetrahedron run through each other, it is left out, for both tetrahedra
/// at the face.
///
/// @param mesh     with the loops' vertices; is added to
/// @param second   a vertex: of which piece it is
/// @param face_of  the corners of the face that two neighbours of a loop lie in
/// @param meet     where the pieces meet in the plane of a face; given a vertex of the first and one of the
///                 second
void add_creased(TriangleMesh& mesh, const std::vector<CreasedLoop>& loops,
                 const std::vector<std::uint8_t>& second,
                 const std::function<std::array<Vec3, 3>(std::uint32_t, std::uint32_t)>& face_of,
                 const std::function<std::optional<Vec3>(const std::array<Vec3, 3>& face, const Vec3&,
                                                         const Vec3&)>& meet);

}  // namespace kreisel::core
