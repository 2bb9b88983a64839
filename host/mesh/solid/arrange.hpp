// arrange.hpp - a surface that runs through itself, cut along all lines in which it does.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "geometry/exact_plane.hpp"
#include "geometry/exact_point_hash.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Points by number, each place once: first the vertices of a mesh, then those that are found.
class PointSet {
 public:
  /// @param vertices  outlive this
  explicit PointSet(const std::vector<Vec3>& vertices) : vertices_(vertices), exact_(vertices.size()) {}

  /// Makes the vertex one that number() may find.
  void know(std::uint32_t vertex);
  [[nodiscard]] std::uint32_t number(ExactPoint point);
  /// Good until the set goes.
  [[nodiscard]] const ExactPoint& operator[](std::uint32_t number) const;
  /// About where it is: a vertex exactly.
  [[nodiscard]] const Vec3& near(std::uint32_t number) const {
    return number < vertices_.size() ? vertices_[number] : exact_[number]->near();
  }
  [[nodiscard]] std::size_t size() const { return exact_.size(); }

 private:
  const std::vector<Vec3>& vertices_;
  mutable std::vector<std::unique_ptr<ExactPoint>> exact_;  ///< of a vertex once it is asked for
  std::unordered_multimap<std::array<double, 3>, std::uint32_t, ExactPointHash> by_place_;
};

/// A mesh whose triangles meet in whole edges and corners alone, or lie on each other in whole patches.
struct Arrangement {
  explicit Arrangement(const std::vector<Vec3>& vertices) : points(vertices) {}

  PointSet points;
  std::vector<Triangle> faces;        ///< by number of their points; as the triangle runs that each is of
  std::vector<std::uint32_t> source;  ///< of each face its triangle in the mesh; ascending
  std::vector<std::uint32_t> patch;   ///< of each face the lowest face of those that no line parts from it
  /// Along every edge as many faces run one way as the other: then each place has a winding number.
  bool closed = true;
};

/// The exact arrangement of a surface's triangles. Those of none of the pairs are faces as they are, those
/// without area of none.
/// @param mesh       outlives the result
/// @param crossings  as from self_intersections()
[[nodiscard]] Arrangement arrange(const TriangleMesh& mesh,
                                  const std::vector<std::array<std::uint32_t, 2>>& crossings);

}  // namespace kreisel::core
