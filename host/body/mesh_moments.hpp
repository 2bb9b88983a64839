// mesh_moments.hpp - exact ten moments of the solid inside a closed triangle mesh.
#pragma once

#include "body/moments.hpp"
#include "device/device.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Ten moments at unit density about the mesh's own origin, summed on the device (mesh_moments.cl).
///
/// @param mesh  closed, outward-oriented; any unit
/// @return      units^3, units^4, units^5; negative for an inside-out mesh
///
/// The sums run about the middle of the bounding box and are moved afterwards, so the error is
/// mesh_moments_bound() times the abs_sum of reference::mesh_moments of the centred mesh. [SpinIt, eq. 4]
[[nodiscard]] Moments mesh_moments(const TriangleMesh& mesh, device::Device& device);

/// Relative to the sum of absolute terms: at most 40 roundings a term, and the summation.
[[nodiscard]] double mesh_moments_bound(const TriangleMesh& mesh, device::Device& device);

namespace reference {

/// The same in plain double on the host, about the origin: what the kernel is tested against, and what a
/// written file is verified with.
[[nodiscard]] MomentSums mesh_moments(const TriangleMesh& mesh);

}  // namespace reference
}  // namespace kreisel::core
