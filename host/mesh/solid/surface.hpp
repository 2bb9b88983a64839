// surface.hpp - a mesh from a file after its repairs, and what there is to know of it.
#pragma once

#include <optional>

#include "mesh/solid/check.hpp"
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
  explicit Surface(TriangleMesh mesh, double weld = 0, RepairReport so_far = {});

  /// Mends nothing.
  [[nodiscard]] static Surface as_it_is(TriangleMesh mesh, RepairReport so_far = {}) {
    Surface surface;
    surface.repairs_ = std::move(so_far);
    surface.mesh_ = std::move(mesh);
    return surface;
  }

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const RepairReport& repairs() const { return repairs_; }
  /// Of the mesh before its repairs.
  [[nodiscard]] const MeshReport& as_read() const { return as_read_; }
  /// Gives the mesh away; what is known of it stays.
  [[nodiscard]] TriangleMesh take_mesh() { return std::move(mesh_); }
  [[nodiscard]] const MeshReport& report();
  /// Pairs of triangles that run through each other (self_intersections.hpp).
  [[nodiscard]] const Pairs& crossings();
  [[nodiscard]] const std::vector<Shell>& shells();
  /// Of each shell those around it (components.hpp).
  [[nodiscard]] const Nesting& enclosing();

 private:
  Surface() = default;

  RepairReport repairs_;
  MeshReport as_read_;
  TriangleMesh mesh_;
  std::optional<MeshReport> report_;
  std::optional<Pairs> crossings_;
  std::optional<std::vector<Shell>> shells_;
  std::optional<Nesting> enclosing_;
};

}  // namespace kreisel::core
