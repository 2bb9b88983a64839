// hydrostatics.hpp - what the water does to a body: the outer mesh clipped at the waterplane.
#pragma once

#include <optional>

#include "body/dry_space.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Of what lies below a horizontal plane and keeps water out, in the mesh's own unit: the material there, and
/// the space within it that water does not come to, as in a boat (dry_space.hpp).
struct Hydrostatics {
  double waterline = 0;                    ///< z of the plane
  double volume = 0;                       ///< displaced, V_b
  Vec3 centre_of_buoyancy = Vec3::Zero();  ///< c_b
  double waterplane_area = 0;
  /// I_w, the least about an axis through the section's centroid; 0 without a section.
  double least_second_moment = 0;
  double least_axis = 0;  ///< azimuth of the axis that it is about, radians from x, in (-pi/2, pi/2]
  double dry = 0;         ///< of the displaced volume what is no material
  /// Of the whole section about its own centroid: the integral of (x, y) (x, y)^T.
  Eigen::Matrix2d second_moments = Eigen::Matrix2d::Zero();

  /// Height of the metacentre: c_b + I_w / V_b. [RayRep, eq. 4]
  [[nodiscard]] double metacentre() const {
    return volume > 0 ? centre_of_buoyancy[2] + least_second_moment / volume : centre_of_buoyancy[2];
  }
};

/// Exact up to round-off: triangles are clipped, the section comes from its boundary by Green's theorem.
/// @param cavities  of the mesh, where they are known from another pose of it
[[nodiscard]] Hydrostatics hydrostatics(const TriangleMesh& mesh, double waterline,
                                        const LazyCavities& cavities = {});

/// The lowest waterline at which the mesh displaces `volume` > 0, to round-off; nothing where it goes under
/// before: displacement grows with depth, but falls where water comes over a rim.
[[nodiscard]] std::optional<double> waterline_of(const TriangleMesh& mesh, double volume,
                                                 const LazyCavities& cavities = {});

/// The most that the mesh can displace at any depth: its volume, or more where it is a boat.
[[nodiscard]] double most_displaced(const TriangleMesh& mesh);

/// The least angle, radians, by which the mesh must heel about a horizontal axis, either way, for the water
/// to come over a rim of its dry space, displacing the same all the while; nothing where it never does, up to
/// a quarter of a turn. To a thousandth of a degree.
/// @param azimuth  of the axis, radians from x
[[nodiscard]] std::optional<double> flooding_heel(const TriangleMesh& mesh, double volume, double azimuth);

}  // namespace kreisel::core
