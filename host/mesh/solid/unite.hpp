// unite.hpp - one surface of solids that overlap, and of one that runs through itself.
#pragma once

#include <optional>

#include "geometry/triangle_mesh.hpp"
#include "kreisel/mending.hpp"

namespace kreisel::core {

using kreisel::InsideOut;

/// The boundary of all places that a surface encloses once or more.
struct United {
  TriangleMesh mesh;
  std::size_t kept = 0;         ///< triangles that are as they were
  double overlap = 0;           ///< volume enclosed more than once, cubed units of the mesh
  double inside_out = 0;        ///< volume that the surface winds around inside out
  Vec3 inside_out_at{0, 0, 0};  ///< a place at it
  bool turned = false;          ///< the surface ran inside out everywhere, and was turned first
};

/// Finds where the triangles meet (arrange.hpp), which sides of each patch are solid (winding.hpp), and keeps
/// the patches with solid behind and none in front. Triangles that meet no other stay as they are, bit for
/// bit; points where others meet are rounded to the precision of the coordinates. Should rounding make
/// triangles meet again, all that is done once more.
///
/// @param inside_out  refused: such places are counted as empty, and told
/// @return  nothing where the surface has no winding numbers, for along an edge not as many triangles run one
///          way as the other; nor where each triangle meets twenty others and more
[[nodiscard]] std::optional<United> unite(const TriangleMesh& mesh, InsideOut inside_out);

}  // namespace kreisel::core
