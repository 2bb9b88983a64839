// hydrostatics.hpp - what the water does to a body: the outer mesh clipped at the waterplane.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Of the part of a closed mesh below a horizontal plane, in the mesh's own unit. Hollows don't matter: only
/// the outer mesh displaces water.
struct Hydrostatics {
  double waterline = 0;                    ///< z of the plane
  double volume = 0;                       ///< displaced, V_b
  Vec3 centre_of_buoyancy = Vec3::Zero();  ///< c_b
  double waterplane_area = 0;
  double least_second_moment = 0;  ///< I_w, of the whole section about its own centroid; 0 without a section
  double least_axis = 0;           ///< azimuth of the axis that it is about, radians from x, in (-pi/2, pi/2]

  /// Height of the metacentre: c_b + I_w / V_b. [RayRep, eq. 4]
  [[nodiscard]] double metacentre() const {
    return volume > 0 ? centre_of_buoyancy[2] + least_second_moment / volume : centre_of_buoyancy[2];
  }
};

/// Exact up to round-off: triangles are clipped, the section comes from its boundary by Green's theorem.
[[nodiscard]] Hydrostatics hydrostatics(const TriangleMesh& mesh, double waterline);

/// The waterline at which the mesh displaces `volume`, to round-off: displacement is strictly monotonic
/// between the lowest and the highest point. @param volume  between 0 and the mesh's own
[[nodiscard]] double waterline_of(const TriangleMesh& mesh, double volume);

}  // namespace kreisel::core
