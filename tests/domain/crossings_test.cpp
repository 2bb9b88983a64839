#include "domain/crossings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "body/test_meshes.hpp"
#include "error.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Column centres at the multiples of 1/4 from -1/2 to 3/2, exactly.
Grid quarter_grid() {
  Grid grid;
  grid.n = {9, 9, 9};
  grid.h = 0.25;
  grid.origin = Vec3::Constant(-0.625);
  return grid;
}

std::size_t at(const Grid& grid, int ix, int iy) {
  return static_cast<std::size_t>(ix) + static_cast<std::size_t>(grid.n[0]) * static_cast<std::size_t>(iy);
}

int balance(std::span<const Crossing> column) {
  int sum = 0;
  for (const Crossing& c : column) sum += c.winding;
  return sum;
}

void expect_balanced_and_sorted(const ColumnCrossings& columns) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto column = columns[k];
    EXPECT_EQ(balance(column), 0);
    EXPECT_TRUE(std::ranges::is_sorted(column, {}, &Crossing::z));
  }
}

/// The cube [0,1]^3: its faces, edges, diagonals and corners all lie on column centres. A line counts as if
/// moved by (eps, eps^2), so columns with 0 <= x < 1 and 0 <= y < 1 are inside, and no other.
void expect_unit_cube(const TriangleMesh& mesh) {
  const Grid grid = quarter_grid();
  const auto columns = column_crossings(mesh, grid);
  ASSERT_EQ(columns.size(), 81u);
  expect_balanced_and_sorted(columns);
  for (int iy = 0; iy < 9; ++iy)
    for (int ix = 0; ix < 9; ++ix) {
      const double x = grid.centre(0, ix), y = grid.centre(1, iy);
      const auto column = columns[at(grid, ix, iy)];
      if (x >= 0 && x < 1 && y >= 0 && y < 1) {
        ASSERT_EQ(column.size(), 2u) << x << ", " << y;
        EXPECT_EQ(column[0].winding, 1);
        EXPECT_EQ(column[0].z, 0.0) << x << ", " << y;
        EXPECT_EQ(column[1].winding, -1);
        EXPECT_EQ(column[1].z, 1.0) << x << ", " << y;
      } else {
        EXPECT_TRUE(column.empty()) << x << ", " << y;
      }
    }
}

TEST(Crossings, MeetACubeOnTheColumnsOnceForEachSide) { expect_unit_cube(box_mesh({0, 0, 0}, {1, 1, 1})); }

TEST(Crossings, DoNotDependOnTheOrderOfTrianglesOrCorners) {
  Random random(11);
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  for (int trial = 0; trial < 20; ++trial) {
    std::ranges::shuffle(mesh.triangles, random);
    for (Triangle& t : mesh.triangles) std::ranges::rotate(t, t.begin() + 1);
    expect_unit_cube(mesh);
  }
}

TEST(Crossings, MeetACubeWithTheOtherDiagonalsAndFansTheSameWay) {
  // Top and bottom as fans around a vertex that itself lies on a column centre.
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 4);
  mesh.vertices.emplace_back(0.5, 0.5, 0);
  mesh.vertices.emplace_back(0.5, 0.25, 1);
  for (const auto& [a, b] : {std::pair{0u, 2u}, {2u, 3u}, {3u, 1u}, {1u, 0u}}) {
    mesh.triangles.push_back({a, b, 8});
    mesh.triangles.push_back({b + 4, a + 4, 9});
  }
  expect_unit_cube(mesh);
}

TEST(Crossings, ThroughTheTipOfATetrahedronEnterAndLeaveOnce) {
  const Grid grid = quarter_grid();
  const TriangleMesh mesh = tetrahedron_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 1});
  const auto columns = column_crossings(mesh, grid);
  expect_balanced_and_sorted(columns);
  const auto tip = columns[at(grid, 3, 3)];
  ASSERT_EQ(tip.size(), 2u);
  EXPECT_EQ(tip[0].z, 0.0);
  EXPECT_EQ(tip[1].z, 1.0);
}

TEST(Crossings, OfATiltedBoxLieOnItsFaces) {
  Random random(12);
  const Eigen::Matrix3d rotation = random_rotation(random);
  const Vec3 middle(0.5, 0.5, 0.5), half(0.4, 0.3, 0.35);
  const TriangleMesh mesh = moved(box_mesh(-half, half), rotation, middle);
  const Grid grid = quarter_grid();
  const auto columns = column_crossings(mesh, grid);
  expect_balanced_and_sorted(columns);
  int met = 0;
  for (int iy = 0; iy < 9; ++iy)
    for (int ix = 0; ix < 9; ++ix)
      for (const Crossing& c : columns[at(grid, ix, iy)]) {
        const Vec3 point(grid.centre(0, ix), grid.centre(1, iy), c.z);
        const Vec3 inside = (rotation.transpose() * (point - middle)).cwiseAbs();
        // On a face: one coordinate at its bound, none beyond. z is a quotient of sums of order one, and a
        // steep face magnifies its rounding; 1e-12 leaves three digits for that.
        EXPECT_NEAR((inside - half).maxCoeff(), 0, 1e-12);
        ++met;
      }
  EXPECT_GT(met, 4);
}

TEST(Crossings, OfTheLetterCMeetItsArmsTwice) {
  const Grid grid = make_grid({{0, 0, 0}, {3, 2, 3}}, {.resolution = 6, .cells = {}});
  const auto columns = column_crossings(letter_c_mesh(2), grid);
  for (int iy = 0; iy < grid.n[1]; ++iy)
    for (int ix = 0; ix < grid.n[0]; ++ix) {
      std::vector<double> z;
      for (const Crossing& c : columns[at(grid, ix, iy)]) z.push_back(c.z);
      EXPECT_EQ(z, grid.centre(0, ix) < 1 ? (std::vector<double>{0, 3}) : (std::vector<double>{0, 1, 2, 3}));
    }
}

TEST(Crossings, OfASolidInsideAnotherCountWindingTwo) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  const TriangleMesh inner = box_mesh({0.3, 0.3, 0.3}, {0.6, 0.6, 0.6});
  for (const Triangle& t : inner.triangles) mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  mesh.vertices.insert(mesh.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  const Grid grid = quarter_grid();
  const auto columns = column_crossings(mesh, grid);
  const auto column = columns[at(grid, 4, 4)];
  ASSERT_EQ(column.size(), 4u);
  EXPECT_EQ(column[1].z, 0.3);
  EXPECT_EQ(column[1].winding, 1);
  EXPECT_EQ(column[2].winding, -1);
}

TEST(Crossings, RefuseAnOpenMeshAndSayWhere) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.triangles.erase(mesh.triangles.begin() + 2);  // a triangle of the lid
  try {
    (void)column_crossings(mesh, quarter_grid());
    FAIL() << "accepted";
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("expected a closed mesh"), std::string::npos) << text;
    EXPECT_NE(text.find("x = "), std::string::npos) << text;
  }
}

TEST(Crossings, OfAFineUprightTorusBalanceEverywhere) {
  // Thousands of triangles with vertices and edges on, and edge-on to, the column centres.
  const TriangleMesh mesh = upright_torus_mesh(0.75, 0.25, 64, 32);
  Grid grid;
  grid.n = {33, 9, 33};
  grid.h = 1.0 / 16;
  grid.origin = {-33.0 / 32, -9.0 / 32, -33.0 / 32};
  const auto columns = column_crossings(mesh, grid);
  expect_balanced_and_sorted(columns);
  EXPECT_EQ(columns[at(grid, 16, 4)].size(), 4u) << "through the hole";
  EXPECT_EQ(columns[at(grid, 4, 4)].size(), 2u) << "through the tube";
  EXPECT_TRUE(columns[at(grid, 0, 0)].empty());
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
