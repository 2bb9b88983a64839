// stem.hpp - a peg to spin on, as a part of the body.
#pragma once

#include <optional>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A round peg along z about the origin, ending in a point; lengths in the mesh's unit.
struct Stem {
  double radius = 0;
  double tip_radius = 0;  ///< of the cone at its end, where it begins; at most `radius`
  double tip_height = 0;  ///< of that cone

  bool operator==(const Stem&) const = default;
};

/// What the user says of it, mm.
struct StemSpec {
  std::optional<double> radius{};      ///< default that of the tip
  std::optional<double> tip_radius{};  ///< default that of the stem
  std::optional<double> tip_height{};  ///< default the tip's radius

  [[nodiscard]] bool wanted() const { return radius || tip_radius; }
  bool operator==(const StemSpec&) const = default;
};

/// @return  nothing where none is wanted
/// @throws InputError  a length that is not > 0, a tip that is wider than its stem, a height without a tip
[[nodiscard]] std::optional<Stem> stem_of(const StemSpec& spec);

/// A solid and its stem, from the first place that the axis meets from below, down to the height of the
/// solid's lowest point, and the cone below that: it stands on the point, at (0, 0, z).
struct Stemmed {
  TriangleMesh mesh;
  double point = 0;  ///< z of the cone's point
};

/// The part of the surface that the peg covers is cut out along it, and the peg's side begins at its rim: one
/// closed surface, without a boolean of meshes.
///
/// @param solid  closed, in the stem's frame: the axis is z
/// @throws InputError  the axis misses the solid, or other parts of the surface are in the peg's way
[[nodiscard]] Stemmed with_stem(const TriangleMesh& solid, const Stem& stem);

}  // namespace kreisel::core
