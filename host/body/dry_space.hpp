// dry_space.hpp - where water does not come: below its level, but within a hull.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Whether a mesh has cavities: shells that face inwards. Found out when it is first asked for, by any
/// thread; copies share it, for a mesh keeps its cavities however it is laid.
class LazyCavities {
 public:
  /// Of this mesh. The same one every time, in any pose.
  [[nodiscard]] bool in(const TriangleMesh& mesh) const;

 private:
  struct Made {
    std::once_flag once;
    bool any = false;
  };
  std::shared_ptr<Made> made_ = std::make_shared<Made>();
};

/// The part of the surface at or below the plane z = level that no water touches: that of hollows whose rim
/// is above the plane all around and that have no way out below it, and of cavities. Decided on the
/// triangles: a wall keeps water out however thin it is.
///
/// The section's loops and the pieces of surface below the plane tell it: two regions of the plane without
/// material are one water where a piece of surface ends in both. A section without holes, of a mesh without
/// cavities, leaves nothing to be asked.
class DrySpace {
 public:
  /// @param mesh  closed, outward; kept
  explicit DrySpace(const TriangleMesh& mesh, LazyCavities cavities = {})
      : mesh_(mesh), cavities_(std::move(cavities)) {}

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  /// For each vertex whether it is of that part; empty where there is none.
  [[nodiscard]] std::vector<char> vertices(double level) const;

 private:
  const TriangleMesh& mesh_;
  LazyCavities cavities_;
};

}  // namespace kreisel::core
