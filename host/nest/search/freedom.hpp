// freedom.hpp - which parts of a placement a search may change, and how they become a position.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nest/decide/nesting.hpp"
#include "nest/search/space.hpp"

namespace kreisel::core::nest {

/// What is free, and what the rest is. Nesting units. [Nest, s. 7.1, fig. 8]
struct Freedom {
  enum Rotation { any_rotation, upright, fixed_rotation } rotation = any_rotation;
  enum Plane { any_plane, through_centroid, fixed_plane } plane = any_plane;
  bool position = true;     ///< B's centroid, within A's box
  bool removal = true;      ///< directions of their own; else along the plane's normal, unless that is fixed
  Vec3 up = Vec3::UnitZ();  ///< what an upright B turns about; unit length
  Placement given;          ///< where not free; an upright B turns from given.pose.rotation

  /// "rotation,position,plane,removal" or any of them; "upright" in place of rotation, "centroid-plane" in
  /// place of plane; "all", "none".
  /// @throws InputError  another name, or both of a pair
  void set_free(std::string_view names);
};

/// Positions that stand for placements: [scale] [rotation] [centroid x y z] [normal] [offset] [plus] [minus],
/// as far as they are free.
///
/// A free plane's offset is counted from the centroid, so that a plane goes along with what it cuts around.
/// Removal directions are kept at least `least_slope` (sine of the angle) away from their plane.
class PlacementSpace {
 public:
  static constexpr double least_slope = 0.05;
  static constexpr double most_offset = 0.5;  ///< of a free plane from the centroid

  /// @param with_scale  whether the scale is part of a position: up to `largest_scale`
  PlacementSpace(const Freedom& freedom, const Box& box, bool with_scale, double largest_scale);

  [[nodiscard]] const Space& space() const { return space_; }
  [[nodiscard]] Placement placement(std::span<const double> x) const;
  void project(std::span<double> x) const;
  /// Removal directions start near the normal, a centroid near one of the places given; everything else is
  /// spread evenly.
  void place(std::span<const double> unit, std::span<double> x) const;
  /// Where centroids start, in place of anywhere in the box; the head of the list more often than its tail.
  void start_near(std::vector<Vec3> centres) { centres_ = std::move(centres); }
  /// The position of a placement, as far as it is free; of a plane and directions that are tied, nothing.
  [[nodiscard]] std::vector<double> position(const Placement& placement) const;

 private:
  [[nodiscard]] Vec3 normal_of(std::span<const double> x) const;

  Freedom freedom_;
  Space space_;
  std::optional<std::size_t> scale_, rotation_, centroid_, normal_, offset_, removal_;
  std::size_t centroid_unit_ = 0;  ///< of the numbers that place() takes, the centroid's first
  std::vector<Vec3> centres_;
};

}  // namespace kreisel::core::nest
