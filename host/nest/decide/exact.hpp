// exact.hpp - feasibility decided on the triangles themselves.
#pragma once

#include "nest/decide/feasibility.hpp"

namespace kreisel::core::nest {

/// Valid if and only if no triangle of A meets what a triangle of T(B) sweeps on the way to the cut, on
/// either side, and T(B) lies inside A: every shell of it, by the winding number of A about a point of it.
/// All vertices, edges and faces of both shapes count and nothing is sampled; the only error is round-off in
/// double, about 1e-15 of A's size. Surfaces that touch are invalid. Needs no device.
///
/// Pairs of triangles are found in a grid across the removal direction: O(triangles + pairs that overlap in
/// that view), on all threads.
class Exact : public Feasibility {
 public:
  explicit Exact(const Nesting& nesting);  ///< keeps a reference

  [[nodiscard]] std::string_view name() const override { return "exact"; }
  using Feasibility::check;
  /// The first fault is that of the first triangle of B, of half 0 before half 1.
  [[nodiscard]] Verdict check(const Placement& placement) override;

 private:
  const Nesting* nesting_;
  std::vector<std::uint32_t> shells_;  ///< a vertex of each shell of B
};

/// How often A winds about a point: 1 inside, 0 outside a closed mesh; between where there are holes. The
/// solid angle of all triangles [Jacobson et al. 2013], by the formula of van Oosterom and Strackee.
[[nodiscard]] double winding_number(const TriangleMesh& mesh, const Vec3& point);

/// A vertex of every connected part of a mesh.
[[nodiscard]] std::vector<std::uint32_t> vertex_of_each_shell(const TriangleMesh& mesh);

}  // namespace kreisel::core::nest
