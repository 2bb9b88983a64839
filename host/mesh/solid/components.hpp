// components.hpp - the shells of a surface: size, topology, volume, and which lies inside which.
#pragma once

#include <optional>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "mesh/query/sides.hpp"

namespace kreisel::core {

/// Triangles connected across edges of exactly two triangles.
struct Shell {
  std::vector<std::uint32_t> triangles;  ///< ascending
  bool closed = true;                    ///< every edge has exactly two triangles
  bool oriented = true;                  ///< no edge along which two triangles run the same way
  long euler = 0;             ///< vertices - edges + faces; a vertex counts once for each fan around it
  std::optional<long> genus;  ///< number of handles; of closed and oriented shells
  double volume = 0;          ///< signed, cubed units of the mesh; positive when facing outward
  Box box;
};

/// In the order of each shell's first triangle. O(n log n).
[[nodiscard]] std::vector<Shell> shells(const TriangleMesh& mesh);
/// The same with the topology at hand.
[[nodiscard]] std::vector<Shell> shells(const TriangleMesh& mesh, Topology& topology);

/// For each shell the others that enclose it; their number is its nesting depth. Exact for closed shells that
/// do not intersect: the parity of the crossings of a ray, by exact signs. O(shells^2) boxes, and the
/// triangles of the shells whose box encloses another's.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> enclosing_shells(const TriangleMesh& mesh,
                                                                       const std::vector<Shell>& shells);

}  // namespace kreisel::core
