// check.hpp - is a mesh the boundary of a solid?
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "geometry/triangle_mesh.hpp"
#include "mesh/query/sides.hpp"

namespace kreisel::core {

/// A kind of fault along edges: how many, and the ends of the first (lowest vertex indices).
struct EdgeFault {
  std::size_t count = 0;
  std::array<std::uint32_t, 2> first{};
};

/// What inspect() finds. Volume in cubed units of the mesh.
struct MeshReport {
  std::size_t repeated_count = 0;             ///< triangles that use a vertex twice
  std::optional<std::size_t> first_repeated;  ///< index of the first of them
  std::size_t flat_count = 0;                 ///< triangles whose three different vertices lie on one line
  std::size_t duplicate_count = 0;            ///< triangles with the same three vertices as an earlier one
  std::size_t equal_vertex_count = 0;         ///< vertices at exactly the place of an earlier one
  std::size_t unused_vertex_count = 0;        ///< vertices of no triangle
  std::size_t pinched_vertex_count = 0;       ///< vertices where parts of the surface merely touch
  EdgeFault open;                             ///< edges of one triangle only
  EdgeFault crowded;                          ///< edges of more than two triangles
  EdgeFault misoriented;                      ///< edges along which two triangles run the same way
  double volume = 0;                          ///< signed; positive when the triangles face outward
  double negligible_volume = 0;               ///< rounding bound: |volume| up to here is none at all

  [[nodiscard]] bool watertight() const { return !open.count && !crowded.count && !repeated_count; }
  [[nodiscard]] bool oriented() const { return !misoriented.count; }
  /// Whether there is nothing to mend, but that shells may face inward.
  [[nodiscard]] bool spotless() const {
    return watertight() && oriented() && !flat_count && !duplicate_count && !equal_vertex_count &&
           !unused_vertex_count;
  }
};

/// Looks at the indices for holes and orientation and at the coordinates for volume; where the surface runs
/// through itself is the question of self_intersections.hpp, of components.hpp what it is made of.
/// O(n log n). Indices must be in range, the mesh not empty.
[[nodiscard]] MeshReport inspect(const TriangleMesh& mesh);
/// The same with its topology at hand.
[[nodiscard]] MeshReport inspect(const TriangleMesh& mesh, Topology& topology);

/// Returns when the mesh bounds a solid: watertight, consistently oriented, outward, of non-zero volume.
/// @param name  what messages call the mesh
/// @throws InputError  the first of: empty, repeated vertex in a triangle, crowded, open or misoriented edge,
///                     zero volume, inside out; one line with number, place and what mends it
void require_solid(const TriangleMesh& mesh, std::string_view name);
/// The same of a mesh that is inspected already. @param report  of the mesh
void require_solid(const TriangleMesh& mesh, const MeshReport& report, std::string_view name);

}  // namespace kreisel::core
