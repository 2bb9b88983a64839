// axle.hpp - a body parted into the two halves of a yo-yo, with an axle between them.
#pragma once

#include <optional>

#include "body/moments.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// An axle along z about the origin, and the slot for its string; lengths in the mesh's unit.
struct Axle {
  double radius = 0;
  double slot = 0;   ///< width of the gap between the halves
  double depth = 0;  ///< of the blind hole in each

  bool operator==(const Axle&) const = default;
};

/// What the user says of it, mm.
struct AxleSpec {
  std::optional<double> radius{};  ///< nothing: no axle, the body stays whole
  std::optional<double> slot{};    ///< default the radius
  std::optional<double> depth{};   ///< default twice the radius

  bool operator==(const AxleSpec&) const = default;
};

/// @return  nothing without a radius
/// @throws InputError  a length that is not > 0, or one that needs a radius without it
[[nodiscard]] std::optional<Axle> axle_of(const AxleSpec& spec);

/// Both halves of a solid, apart by the slot, each with a hole that the axle is pressed into.
///
/// @param solid  a closed mesh in mm in the axle's frame: origin at its centre, z along it
/// @throws InputError  the holes would break through the surface
[[nodiscard]] TriangleMesh halves(const TriangleMesh& solid, const Axle& axle);

/// The axle itself, a prism of as many sides as the holes: it fills them and bridges the slot.
[[nodiscard]] TriangleMesh axle_mesh(const Axle& axle);

/// The triangles of `mesh` above z = 0 or below it. None of them may cross it.
[[nodiscard]] TriangleMesh half_of(const TriangleMesh& mesh, bool upper);

}  // namespace kreisel::core
