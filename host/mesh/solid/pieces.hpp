// pieces.hpp - the bodies that a surface bounds: which shells are one rigid piece.
#pragma once

#include "mesh/solid/surface.hpp"

namespace kreisel::core {

/// A shell with the cavities in it, and others that touch it.
struct Piece {
  std::vector<std::uint32_t> shells;  ///< ascending
  double volume = 0;                  ///< cubed units of the mesh
  Vec3 at{0, 0, 0};                   ///< the middle of its box
};

/// Largest first. Shells belong together where they have a point in common; a shell within a cavity is a
/// piece of its own. @param surface  of a solid (solid.hpp)
[[nodiscard]] std::vector<Piece> pieces_of(Surface& surface);

/// The triangles of some of the pieces, in the order of the mesh, with their vertices.
[[nodiscard]] TriangleMesh mesh_of(Surface& surface, const std::vector<Piece>& chosen);

}  // namespace kreisel::core
