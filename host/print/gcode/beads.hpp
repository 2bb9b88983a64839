// beads.hpp - the moments of what a nozzle lays down, before anybody says how thick the filament is.
#pragma once

#include "body/moments.hpp"
#include "kreisel/mesh.hpp"

namespace kreisel::core {

using kreisel::Vec3;

/// A sum of beads. A bead is what is laid along one straight move or arc: its cross-section is a rectangle,
/// the layer's height below the nozzle's path, and as wide as its volume over length and height says. So
/// parallel beads a width apart fill a layer without gaps and overlaps, as slicers space them.
///
/// Slicers write the filament's diameter at the end of a file. With A its area, a bead's moments are
/// A x (what its path gives) + A^3 x (what its width gives): both are summed here, and A comes last.
class Beads {
 public:
  /// A straight one. @param from, to  path of the nozzle's tip, mm  @param filament  length of it, mm
  /// @param height  of the layer, mm, > 0
  void add_line(const Vec3& from, const Vec3& to, double filament, double height);
  /// One along an arc about a vertical axis, exactly; its height above the bed may change steadily.
  /// @param centre  its z is not looked at  @param angle  counter-clockwise, radians; may be more than a turn
  void add_arc(const Vec3& from, const Vec3& to, const Vec3& centre, double angle, double filament,
               double height);
  /// What is laid down while the nozzle stands: a column without width.
  void add_blob(const Vec3& at, double filament, double height);

  Beads& operator+=(const Beads& other);

  /// mm of filament.
  [[nodiscard]] double filament() const { return by_area_[S1]; }
  /// At density 1: mm^3, mm^4, mm^5. @param area  of the filament's cross-section, mm^2
  [[nodiscard]] Moments moments(double area) const { return area * by_area_ + area * area * area * by_cube_; }

 private:
  Moments by_area_ = Moments::Zero(), by_cube_ = Moments::Zero();
};

}  // namespace kreisel::core
