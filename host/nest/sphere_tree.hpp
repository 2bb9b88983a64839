// sphere_tree.hpp - a binary tree of spheres about the triangles of a mesh.
#pragma once

#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace kreisel::nest {

/// Spheres keep their size however they are turned, and one transformed point is all it costs to place one:
/// the same tree serves every pose.
class SphereTree {
 public:
  struct Node {
    Vec3 centre = Vec3::Zero();
    double radius = 0;  ///< of a ball that holds its triangles, rounded up
    std::uint32_t
        first;  ///< of a leaf its first place in order(), else its first child; the second follows it
    std::uint32_t count = 0;  ///< triangles of a leaf, 0 for others
  };

  explicit SphereTree(const TriangleMesh& mesh);

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }  ///< the root first
  /// Triangles, those of a leaf one after the other.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace kreisel::nest
