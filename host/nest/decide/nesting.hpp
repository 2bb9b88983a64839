// nesting.hpp - one shape in another, a cut, and the ways out.
#pragma once

#include "geometry/plane.hpp"

namespace kreisel::core::nest {

// Everything in this folder is in nesting units: the outer shape A lies about the origin in the ball of
// radius 1 (half the diagonal of its box), the inner shape B about its own centroid, in the same unit: at
// scale 1 it is as large as in its file. [Nest, s. 3]

/// The similarity T(x) = scale * rotation * x + centroid that puts B into A.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 centroid = Vec3::Zero();  ///< where B's centroid goes
  double scale = 1;
};

/// The plane, its normal of unit length as the directions, cuts A in two. The half above it leaves along
/// `plus`, the half below along `minus`.
struct Cut : Plane {
  Vec3 plus = Vec3::UnitZ(), minus = -Vec3::UnitZ();

  /// Through a point, both halves leaving along the normal.
  [[nodiscard]] static Cut through(const Vec3& point, const Vec3& normal);
  [[nodiscard]] const Vec3& removal(int half) const { return half == 0 ? plus : minus; }
  /// The plane seen from half 0 (plus) or 1 (minus): that half lies above.
  [[nodiscard]] Plane into(int half) const { return half == 0 ? Plane(*this) : reversed(); }
  /// How far a point lies beyond the plane on the side of a half.
  [[nodiscard]] double beyond(int half, const Vec3& x) const { return half == 0 ? above(x) : -above(x); }
};

/// All that decides whether B nests in A.
struct Placement {
  Pose pose;
  Cut cut;
};

/// @throws InputError  a scale that is not positive and finite, a rotation that is none (reflections and
///                     shears are named), a centroid or plane that is not finite, a normal or direction that
///                     is not of unit length, or one that does not lead away from the plane on its side
void require_valid(const Placement& placement);

/// An outer and an inner mesh in nesting units. Neither has to be closed or free of self-intersections; see
/// docs/nesting.md for what that costs.
class Nesting {
 public:
  /// Meshes in one length unit, each in coordinates of its own.
  /// @throws InputError  a mesh without triangles or extent, with indices or coordinates out of range; an
  ///                     outer mesh that is inside out, encloses nothing or gapes
  Nesting(TriangleMesh outer, TriangleMesh inner);

  [[nodiscard]] const TriangleMesh& outer() const { return outer_; }
  [[nodiscard]] const TriangleMesh& inner() const { return inner_; }
  [[nodiscard]] const Box& outer_box() const { return box_; }
  [[nodiscard]] double unit() const { return unit_; }  ///< in the meshes' length unit

  /// Of each solid in its file; of a sheet that of its area.
  [[nodiscard]] const Vec3& outer_centroid() const { return outer_centroid_; }
  [[nodiscard]] const Vec3& inner_centroid() const { return inner_centroid_; }

  /// From coordinates of the outer file to nesting units, and back.
  [[nodiscard]] Vec3 to_units(const Vec3& x) const { return (x - centre_) / unit_; }
  [[nodiscard]] Vec3 to_file(const Vec3& x) const { return unit_ * x + centre_; }
  /// Maps the inner file's coordinates into the outer's, row by row.
  [[nodiscard]] Eigen::Matrix<double, 3, 4> transform(const Pose& pose) const;

  /// No scale beyond this can nest: B would be longer than A's diagonal, or of more volume than A (where both
  /// enclose one). 1 for a shape in itself.
  [[nodiscard]] double largest_scale() const { return largest_scale_; }

 private:
  TriangleMesh outer_, inner_;
  Vec3 centre_, outer_centroid_, inner_centroid_;  ///< of each file
  double unit_ = 1, largest_scale_ = 1;
  Box box_;
};

}  // namespace kreisel::core::nest
