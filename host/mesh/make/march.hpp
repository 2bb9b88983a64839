// march.hpp - marching tetrahedra on a body-centred cubic lattice.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Corners and centres of the cubes of a uniform grid. Corners have even indices, centres odd ones; one unit
/// is half a cube's edge.
class CubicLattice {
 public:
  using Index = Eigen::Vector3i;

  /// Centred on the box, so that a symmetric solid gets a symmetric lattice, with a cube or more of margin on
  /// every side. @param cell  edge of the cubes, > 0, in the unit of the box
  CubicLattice(const Box& box, double cell);

  [[nodiscard]] double cell() const { return 2 * half_; }
  [[nodiscard]] const Index& n() const { return n_; }  ///< indices along each axis; odd
  [[nodiscard]] Vec3 point(const Index& at) const { return origin_ + half_ * at.cast<double>(); }

  /// Place of a point in a list of all of them, below size(). In a layer all x and y have the parity of z, so
  /// halving them leaves no two points on one place.
  [[nodiscard]] std::size_t id(const Index& at) const {
    return (std::size_t(at.z()) * std::size_t(n_.y() / 2 + 1) + std::size_t(at.y() / 2)) *
               std::size_t(n_.x() / 2 + 1) +
           std::size_t(at.x() / 2);
  }
  [[nodiscard]] std::size_t size() const {
    return std::size_t(n_.x() / 2 + 1) * std::size_t(n_.y() / 2 + 1) * std::size_t(n_.z());
  }
  /// Whether the point lies in the outermost layers, whose edges are not all cut.
  [[nodiscard]] bool rim(const Index& at) const {
    return (at.array() <= 1).any() || (at.array() >= n_.array() - 2).any();
  }

  template <class Visit>
  void for_each(Visit&& visit) const {
    for (int k = 0; k < n_.z(); ++k)
      for (int j = k % 2; j < n_.y(); j += 2)
        for (int i = k % 2; i < n_.x(); i += 2) visit(Index(i, j, k));
  }

 private:
  double half_;
  Vec3 origin_;
  Index n_;
};

/// Where on the edge between a point inside and one outside the surface goes through: strictly between them.
/// Called once an edge, from several threads.
using PlaceOnEdge = std::function<Vec3(const CubicLattice::Index& in, const CubicLattice::Index& out)>;

/// The surface between the lattice points inside and the others. All tetrahedra have one shape (their longest
/// edge is a cube's edge), and as each cuts the surface in one triangle or quadrilateral at most, the mesh is
/// closed, a manifold and free of intersections whatever is inside. Triangles face away from the inside; same
/// input, same mesh.
/// @param inside  by id, 1 or 0; nothing on the rim
[[nodiscard]] TriangleMesh march(const CubicLattice& lattice, const std::vector<std::uint8_t>& inside,
                                 const PlaceOnEdge& place);

/// A surface of two smooth pieces, sharp where they meet. Called from several threads.
struct TwoPieces {
  struct Point {
    Vec3 at;
    bool second;  ///< which piece it is of
  };
  /// As PlaceOnEdge.
  std::function<Point(const CubicLattice::Index& in, const CubicLattice::Index& out)> place;
  /// Where both meet in the plane of a triangle of the lattice, given a point of each on the triangle's
  /// edges; nothing where they do not.
  std::function<std::optional<Vec3>(const std::array<Vec3, 3>& face, const Vec3& first, const Vec3& second)>
      meet;
};

/// The same with vertices also where the crease runs through the tetrahedra's faces, and edges along it. What
/// is in a tetrahedron stays in it, and where it would run through itself there, its crease stays blunt: the
/// mesh remains closed, a manifold and free of intersections.
[[nodiscard]] TriangleMesh march(const CubicLattice& lattice, const std::vector<std::uint8_t>& inside,
                                 const TwoPieces& surface);

}  // namespace kreisel::core
