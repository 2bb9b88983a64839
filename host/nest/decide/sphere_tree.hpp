// sphere_tree.hpp - a binary tree of balls and slabs about the triangles of a mesh.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core::nest {

/// Each node holds its triangles in a ball and between two planes. Both keep their size however they are
/// turned, so the same tree serves every pose. A patch of surface of radius r is about r^2 thick: the planes
/// tell surfaces apart that run close to each other, long before balls would.
class SphereTree {
 public:
  /// In single precision, with room for its rounding: coordinates up to 4 keep within it after a rotation.
  struct Node {
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    float radius = 0;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit length, outward on average
    float least = 0, most = 0;                         ///< of normal . (x - centre)
    std::uint32_t first = 0;  ///< of a leaf its triangle, else its first child; the second follows it
    std::uint32_t leaf = 0;   ///< 1 for a leaf

    [[nodiscard]] bool is_leaf() const { return leaf != 0; }
  };

  explicit SphereTree(const TriangleMesh& mesh);

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }  ///< the root first

 private:
  std::vector<Node> nodes_;
};

}  // namespace kreisel::core::nest
