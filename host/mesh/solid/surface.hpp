// surface.hpp - a mesh from a file after its repairs, and what there is to know of it.
#pragma once

#include <optional>

#include "mesh/solid/components.hpp"
#include "mesh/solid/repair.hpp"

namespace kreisel::core {

/// A repaired mesh, solid or not. Each question is answered when it is first asked, and only then: on a mesh
/// without any order the later ones cost the square of its triangles.
class Surface {
 public:
  using Pairs = std::vector<std::array<std::uint32_t, 2>>;
  using Nesting = std::vector<std::vector<std::uint32_t>>;

  /// Mends the mesh (repair.hpp). @param so_far  what is to be said of it beforehand
  explicit Surface(TriangleMesh mesh, double weld = 0, RepairReport so_far = {})
      : repairs_(std::move(so_far)), mesh_(repaired(std::move(mesh), repairs_, weld)) {}

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const RepairReport& repairs() const { return repairs_; }
  /// Pairs of triangles that run through each other (self_intersections.hpp).
  [[nodiscard]] const Pairs& crossings();
  [[nodiscard]] const std::vector<Shell>& shells();
  /// Of each shell those around it (components.hpp).
  [[nodiscard]] const Nesting& enclosing();

 private:
  RepairReport repairs_;
  TriangleMesh mesh_;
  std::optional<Pairs> crossings_;
  std::optional<std::vector<Shell>> shells_;
  std::optional<Nesting> enclosing_;
};

}  // namespace kreisel::core
