// implicit_mesh.hpp - a closed mesh of { field < 0 }.
#pragma once

#include <functional>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Negative inside a solid, positive outside; continuous, and near its zero set about a distance.
using ScalarField = std::function<double(const Vec3&)>;

/// The surface field = 0 inside a box, by marching tetrahedra on a body-centred cubic lattice (the tetrahedra
/// have one shape, and as each cuts the surface in one triangle or quadrilateral at most, the mesh is closed
/// and manifold whatever the field). Then the vertices are evened out along the surface and moved onto the
/// zero set by Newton's method, which makes the mesh second-order accurate. Parts thinner than a cell may be
/// lost. Triangles face outward; same input, same mesh.
/// @param box   holds the solid
/// @param cell  edge of the lattice's cubes, > 0, in the unit of the box; about 14 triangles a cell^2 of area
/// @throws std::logic_error  the field is negative beyond the box
[[nodiscard]] TriangleMesh mesh_of(const ScalarField& field, const Box& box, double cell);

}  // namespace kreisel::core
