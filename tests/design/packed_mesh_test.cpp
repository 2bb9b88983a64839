// packed_mesh_test.cpp - what a page holds of a mesh is the mesh, up to a 2^15th of its length, in few bytes.
#include "design/packed_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "body/models/geodesic.hpp"
#include "mesh/shapes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Place = std::array<long, 3>;
using Corners = std::array<Place, 3>;

/// Its triangles in no order, each from its least corner on; places in steps of the packed mesh.
std::vector<Corners> triangles_of(const TriangleMesh& mesh, const PackedMesh& by) {
  std::vector<Corners> all;
  for (const Triangle& t : mesh.triangles) {
    Corners c;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<Eigen::Index>(a);
        c[k][a] = std::lround((mesh.vertices[t[k]][axis] - by.low[axis]) / by.step);
      }
    std::ranges::rotate(c, std::ranges::min_element(c));
    all.push_back(c);
  }
  std::ranges::sort(all);
  return all;
}

void comes_back(const TriangleMesh& mesh) {
  const PackedMesh small = packed(mesh);
  const TriangleMesh back = unpacked(small);
  EXPECT_EQ(small.triangles, mesh.triangles.size());
  EXPECT_EQ(back.vertices.size(), small.corners);
  EXPECT_EQ(triangles_of(back, small), triangles_of(mesh, small));
}

TEST(PackedMesh, IsTheMeshUpToHalfAStep) {
  comes_back(geodesic_sphere(1));
  comes_back(geodesic_sphere(24));
  comes_back(torus(40, 17));
  comes_back(torus(200, 150));  // with numbers that need two bytes
}

TEST(PackedMesh, HoldsWhatIsNoManifold) {
  const TriangleMesh ball = geodesic_sphere(5);
  comes_back(both(ball, inverted(ball)));
  comes_back(soup(ball));  // open: nothing touches anything
  TriangleMesh holed = ball;
  holed.triangles.erase(holed.triangles.begin() + 7, holed.triangles.begin() + 40);
  comes_back(holed);
  TriangleMesh book;  // four pages of one spine, and of one corner a fan of 300 triangles
  book.vertices = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  book.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}};
  constexpr std::uint32_t fan = 300;
  for (std::uint32_t i = 0; i <= fan; ++i)
    book.vertices.emplace_back(std::cos(0.02 * i), std::sin(0.02 * i), 3);
  for (std::uint32_t i = 0; i < fan; ++i) book.triangles.push_back({1, 6 + i, 7 + i});
  comes_back(book);
}

TEST(PackedMesh, LeavesOutTrianglesWithoutAnArea) {
  TriangleMesh mesh = geodesic_sphere(3);
  const std::vector<Corners> before = triangles_of(mesh, packed(mesh));
  mesh.triangles.push_back({0, 0, 1});
  const PackedMesh small = packed(mesh);
  EXPECT_EQ(triangles_of(unpacked(small), small), before);
  EXPECT_EQ(packed({}).corners, 0U);
}

TEST(PackedMesh, OfASurfaceTakesTwoBytesATriangle) {
  const TriangleMesh ball = geodesic_sphere(64);
  const PackedMesh small = packed(ball);
  std::vector<std::uint8_t> bytes = small.links;
  bytes.insert(bytes.end(), small.places.begin(), small.places.end());
  // In base64 four letters are three bytes.
  EXPECT_LT(0.75 * static_cast<double>(compressed_text(bytes.data(), bytes.size()).size()),
            2.0 * static_cast<double>(ball.triangles.size()));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
