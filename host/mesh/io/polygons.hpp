// polygons.hpp - faces of any number of corners, and the triangles within them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "mesh/io/mesh_reading.hpp"

namespace kreisel::core {

/// Vertices and faces as a file has them.
class PolygonMesh {
 public:
  std::vector<Vec3> vertices;

  /// A face of three corners or more.
  void add(std::span<const std::uint32_t> corners) {
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    ends_.push_back(corners_.size());
  }
  [[nodiscard]] std::size_t faces() const { return ends_.size(); }
  [[nodiscard]] std::span<const std::uint32_t> face(std::size_t f) const {
    const std::size_t first = f ? ends_[f - 1] : 0;
    return {corners_.data() + first, ends_[f] - first};
  }

 private:
  std::vector<std::uint32_t> corners_;
  std::vector<std::size_t> ends_;
};

/// The mesh with every face cut into triangles that run as it does, use each of its corners and stay within
/// its outline, on the plane that fits it best: the face may be concave, have corners on a straight side, and
/// go to a hole and back by the same edge. One that crosses itself has no inside and becomes a fan about its
/// first corner; a note counts them.
/// @pre  every corner is a vertex
[[nodiscard]] MeshReading triangulated(PolygonMesh polygons);

}  // namespace kreisel::core
