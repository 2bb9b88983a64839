// surface_energy.hpp - how far and how bent a surface is from what it was, by handles that also scale.
#pragma once

#include <Eigen/Core>

#include "deform/cage_handles.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// What handle j does to a point v: sum_j w_j(v) (u_j v + t_j). Entry 4 j is u_j, three of t_j follow; all
/// zero where nothing moves (the paper's u_j less 1). [SpinIt, s. 6]
using ScaledHandles = Eigen::VectorXd;

/// A point's displacement by each of them: (3, 4 handles).
[[nodiscard]] Eigen::MatrixXd displacement_rows(const HandleWeights& weights, const Vec3& v,
                                                std::size_t handles);

/// R of x^T R x / 2, the regularisers of [SpinIt, s. 6.1] as means over vertices:
///
///     gamma_dl mean |side^2 / e^2 L_D d|^2 + gamma_dv mean |d - mean d|^2,
///
/// d the displacement of a vertex, e the mean length of its edges, L_D the Laplacian that follows the
/// linearised rotation and scale of what is around a vertex [Sorkine et al., Laplacian surface editing,
/// 2004]: it is zero for the surface as it was. As means they hardly depend on how fine the mesh is.
[[nodiscard]] Eigen::MatrixXd surface_energy(const TriangleMesh& mesh, const CageHandles& handles,
                                             double gamma_dl, double gamma_dv);

/// The same of any displacement. @param to  the vertices where they are now
[[nodiscard]] double surface_energy(const TriangleMesh& mesh, const std::vector<Vec3>& to, double gamma_dl,
                                    double gamma_dv);

}  // namespace kreisel::core
