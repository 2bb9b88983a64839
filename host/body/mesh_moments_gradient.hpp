// mesh_moments_gradient.hpp - how the ten moments of a mesh's solid change as its vertices move.
#pragma once

#include <array>
#include <vector>

#include "body/moments.hpp"
#include "device/device.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// The derivative of q . s(mesh) in every vertex, on the device (mesh_moments_gradient.cl).
///
/// q . s is the integral of the quadric q over the solid, so where the surface moves with velocity V it grows
/// by the integral of q V . n. A vertex moves the triangles beside it by its hat function: over each, q times
/// that is a cubic whose integral has a closed form. Exact for the mesh as it is. [SpinIt, eq. 4, derived]
///
/// @param mesh  closed, outward-oriented; coordinates that q is of
/// @return      one vector a vertex
[[nodiscard]] std::vector<Vec3> mesh_moments_gradient(const TriangleMesh& mesh, const Moments& q,
                                                      device::Device& device);

/// The mean over a triangle of q times each of its three hat functions.
[[nodiscard]] std::array<double, 3> means_with_hats(const Moments& q, const std::array<Vec3, 3>& corners);

namespace reference {

/// The same in plain double on the host, triangle by triangle.
[[nodiscard]] std::vector<Vec3> mesh_moments_gradient(const TriangleMesh& mesh, const Moments& q);

}  // namespace reference
}  // namespace kreisel::core
