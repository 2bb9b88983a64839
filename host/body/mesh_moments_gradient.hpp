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
/// @param mesh  closed, outward-oriented; in the coordinates that q is of
/// @return      one vector a vertex; within mesh_moments_gradient_bound() times the reference's abs_sum of
///              the mesh about the middle of its box
[[nodiscard]] std::vector<Vec3> mesh_moments_gradient(const TriangleMesh& mesh, const Moments& q,
                                                      device::Device& device);

/// Relative to the sum of absolute terms: at most 60 roundings a term, and one for each triangle beside a
/// vertex.
[[nodiscard]] double mesh_moments_gradient_bound(const TriangleMesh& mesh, const device::Device& device);

/// The mean over a triangle of q times each of its three hat functions.
[[nodiscard]] std::array<double, 3> means_with_hats(const Moments& q, const std::array<Vec3, 3>& corners);

namespace reference {

struct GradientSums {
  std::vector<Vec3> value;
  std::vector<double> abs_sum;  ///< of the absolute values of all that is added up for a vertex
};

/// The same in plain double on the host, triangle by triangle.
[[nodiscard]] GradientSums mesh_moments_gradient(const TriangleMesh& mesh, const Moments& q);

}  // namespace reference
}  // namespace kreisel::core
