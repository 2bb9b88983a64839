// shape.hpp - one deformed state of a body, as the solver sees it.
#pragma once

#include <memory>
#include <vector>

#include "deform/inner_surface.hpp"
#include "formulation/quadric.hpp"
#include "solve/solver.hpp"

namespace kreisel::core {

/// Over which rays shapes of one body are compared.
struct ShapeRays {
  Grid grid;    ///< with room for the body to grow
  double wall;  ///< body units
};
/// @param room  by how much the body may grow on every side, in longest sides
[[nodiscard]] ShapeRays shape_rays(const Body& body, const GridSpec& spec, const Wall& wall, double room);

/// A body with its mesh moved, in the frame and units of the undeformed one: exact moments, the rays of its
/// interior, and how h(q), the least value of q . s over all its fillings, changes with the skin.
class Shape {
 public:
  /// @param undeformed  outlives it  @param local  its mesh with the vertices moved, body frame and units
  /// @throws InputError  no interior is left, or the mesh is not closed
  Shape(const Body& undeformed, TriangleMesh local, const ShapeRays& rays, device::Device& device);

  [[nodiscard]] const TriangleMesh& mesh() const { return body_.local; }
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const MassModel& mass() const { return mass_; }
  [[nodiscard]] const ExactColumns& domain() const { return domain_; }
  [[nodiscard]] Task task(const Problem& problem, std::stop_token stop = {}) const {
    return {problem, *quadric_, mass_, device_, std::move(stop)};
  }
  /// h(q) of the totals, shell included.
  [[nodiscard]] double least(const Moments& q) const;
  /// The derivative of h(q) in every vertex of the skin:
  ///
  ///     dh = int_skin q v . n + int_inner [(light - 1) q + contrast min(q, 0)] n . v(foot)
  ///
  /// with densities in those of the shell. [docs/deformation.md]
  [[nodiscard]] std::vector<Vec3> gradient_of_least(const Moments& q) const {
    return gradient_of_least(q, inner());
  }
  /// The same with other pieces of the interior's boundary: of its rays alone, say.
  [[nodiscard]] std::vector<Vec3> gradient_of_least(const Moments& q,
                                                    const std::vector<InnerPiece>& inner) const;

 private:
  [[nodiscard]] const std::vector<InnerPiece>& inner() const;

  Body body_;  ///< local mesh and moments deformed; all else of the undeformed one
  ShapeRays rays_;
  ExactColumns domain_;
  MassModel mass_;
  device::Device& device_;
  std::unique_ptr<Formulation> quadric_;
  mutable std::vector<InnerPiece> inner_;  ///< made when first asked for
};

}  // namespace kreisel::core
