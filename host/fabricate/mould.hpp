// mould.hpp - two halves around what is to be cast.
#pragma once

#include <vector>

#include "fabricate/cut_part.hpp"
#include "fabricate/parting.hpp"

namespace kreisel::core {

/// A mould to cast a solid in: a block with the solid as its cavity, a sprue to pour through and vents for
/// the air, in two halves with pins that align them.
struct Mould {
  std::vector<MaterialPart>
      parts;        ///< upper, lower and pegs, laid flat; "model" coordinates: z is up in the block
  Parting parting;  ///< of the casting, in its own coordinates; metal is poured against the normal
  double sprue_radius = 0, vent_radius = 0;  ///< mm
  std::size_t vents = 0;
  double casting = 0;  ///< of the solid, mm^3
  double cavity = 0;   ///< of what the mould makes of it, without sprue and vents, mm^3
  double metal = 0;    ///< to be poured, sprue and vents with it: by the halves as they are, mm^3
};

/// The solids that a part's casting consists of, one a mould; drops smaller than `least` are left out.
/// @throws InputError  one that encloses a void, which no mould of two halves leaves free
[[nodiscard]] std::vector<TriangleMesh> castings_of(const MaterialPart& part, double least);

/// The halves meet where they come off best (parting.hpp), turned so that fewer vents are needed. Sprue and
/// vents run along the direction in which the upper half is drawn off, so they hold nothing back; they begin
/// at the highest place and at those where air would stay (high_places.hpp).
///
/// The cavity is meshed by marching tetrahedra, its vertices on the casting's own surface: the mesh is a
/// manifold free of intersections, and edges of the casting are blunt by less than a cell, a hundredth of its
/// size.
///
/// @param casting  closed, one shell, mm
[[nodiscard]] Mould mould_of(const TriangleMesh& casting);

}  // namespace kreisel::core
