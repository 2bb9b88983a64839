#include "body/models.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "body/crossings_by_force.hpp"
#include "body/mesh_solid.hpp"
#include "body/models/geodesic.hpp"
#include "body/models/shapes.hpp"
#include "error.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Vec3 lowest_point(const TriangleMesh& mesh) {
  return *std::min_element(mesh.vertices.begin(), mesh.vertices.end(),
                           [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
}

class EveryModel : public ::testing::TestWithParam<std::string> {
 protected:
  const Model& model() const { return *find_model(GetParam()); }
};

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Model& m : models()) all.emplace_back(m.name);
  return all;
}

std::string test_name(const ::testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::ranges::replace(name, '-', '_');
  return name;
}

TEST_P(EveryModel, IsASolidOfAboutTwentySquaredTriangles) {
  for (const int n : {1, 2, 30, 37}) {
    const TriangleMesh mesh = model().make(n);
    EXPECT_NO_THROW(require_solid(mesh, GetParam())) << "fineness " << n;
    if (n >= 30) {
      EXPECT_NEAR(double(mesh.triangles.size()), 20 * n * n, 0.2 * 20 * n * n) << "fineness " << n;
    }
  }
}

TEST_P(EveryModel, HasTheExtentItStates) {
  const Box box = bounding_box(model().make(model().default_fineness));
  // Of the chords of a mesh this fine, the longest sags by some hundredths of a millimetre.
  EXPECT_NEAR(box.extent().maxCoeff(), model().size, 0.03);
  EXPECT_LT(box.lo.cwiseAbs().maxCoeff(), 0.05) << "begins at the origin";
}

TEST_P(EveryModel, IsTheSameEveryTime) {
  const TriangleMesh once = model().make(14), again = model().make(14);
  EXPECT_EQ(once.vertices, again.vertices);
  EXPECT_EQ(once.triangles, again.triangles);
}

TEST_P(EveryModel, HasOnePieceAndTheHolesItShows) {
  const TriangleMesh mesh = model().make(24);
  const bool loop = GetParam() == "teapot" || GetParam() == "kitten" || GetParam() == "woven-ring";
  const int holes = GetParam() == "dancers" ? 2 : loop ? 1 : 0;
  EXPECT_EQ(std::ptrdiff_t(mesh.vertices.size()) - std::ptrdiff_t(mesh.triangles.size() / 2), 2 - 2 * holes);
}

TEST_P(EveryModel, HasEvenTriangles) {
  const TriangleMesh mesh = model().make(40);
  double least = 180;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 u = mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]],
                 v = mesh.vertices[t[(k + 2) % 3]] - mesh.vertices[t[k]];
      least = std::min(least, std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi);
    }
  EXPECT_GT(least, 9);  // degrees; slivers, of which kernels and other programs are afraid, have under 5
}

TEST_P(EveryModel, DoesNotCrossItself) {
  for (const int n : {12, 33}) EXPECT_EQ(crossing_edges(model().make(n)), 0) << "fineness " << n;
}

TEST_P(EveryModel, RefusesFinenessBelowOne) {
  EXPECT_THROW((void)model().make(0), InputError);
  EXPECT_THROW((void)model().make(-3), InputError);
}

INSTANTIATE_TEST_SUITE_P(Models, EveryModel, ::testing::ValuesIn(names()), test_name);

class StarShapedModel : public EveryModel {};

TEST_P(StarShapedModel, IsAGeodesicSphereInItsTriangles) {
  for (const int n : {1, 2, 7, 64}) {
    const TriangleMesh mesh = model().make(n);
    EXPECT_EQ(mesh.triangles.size(), std::size_t(20 * n * n));
    EXPECT_EQ(mesh.vertices.size(), std::size_t(10 * n * n + 2));
  }
}

TEST_P(StarShapedModel, ConvergesQuadraticallyInVolume) {
  const double v8 = solid_of(model().make(8)).volume, v16 = solid_of(model().make(16)).volume,
               v32 = solid_of(model().make(32)).volume, v64 = solid_of(model().make(64)).volume;
  EXPECT_LT(v8, v64);
  // Halving the edges quarters the error: differences fall by 4, the small features of the bird a little
  // later.
  EXPECT_NEAR((v32 - v16) / (v64 - v32), 4.0, 0.8);
}

TEST_P(StarShapedModel, CannotSpinAsASolid) {
  const TriangleMesh mesh = model().make(64);
  const Vec3 off = solid_of(mesh).centre - lowest_point(mesh);
  EXPECT_GT(off.head<2>().norm(), 0.03 * 60);  // at least 3 % of the length beside the axis
}

INSTANTIATE_TEST_SUITE_P(Models, StarShapedModel, ::testing::Values("ellipsoid", "bird"), test_name);

TEST(Models, AreFoundByNameOnly) {
  for (const Model& m : models()) EXPECT_EQ(find_model(m.name), &m);
  EXPECT_EQ(find_model("nosuch"), nullptr);
}

TEST(Geodesic, HasUnitVerticesAndTheVolumeOfABallInTheLimit) {
  const TriangleMesh sphere = geodesic_sphere(48);
  for (const Vec3& v : sphere.vertices) ASSERT_NEAR(v.norm(), 1.0, 1e-15);
  const double ball = 4 * std::numbers::pi / 3;
  const double edge =
      1.2 / 48;  // longest, a chord whose sagitta edge^2 / 8 bounds the gap to the sphere twice over
  EXPECT_LT(solid_of(sphere).volume, ball);
  EXPECT_GT(solid_of(sphere).volume, ball * (1 - 3 * edge * edge / 4));
}

TEST(Geodesic, IsTheIcosahedronAtFrequencyOne) {
  const TriangleMesh mesh = geodesic_sphere(1);
  for (const auto& [a, b, c] : mesh.triangles)
    EXPECT_NEAR((mesh.vertices[a] - mesh.vertices[b]).norm(), 4 / std::sqrt(10 + 2 * std::sqrt(5.0)), 1e-15);
}

TEST(Ellipsoid, HasTheProportionsAndVolumeItsFormulaGives) {
  const TriangleMesh mesh = find_model("ellipsoid")->make(64);
  const Box box = bounding_box(mesh);
  // A vertex misses the true extreme by at most a sagitta, (1.2 / 64)^2 / 8 of the half length.
  EXPECT_LT((box.extent() - Vec3(60, 39, 38.25)).cwiseAbs().maxCoeff(), 60 * 1.2 * 1.2 / 64 / 64 / 8);
  const Vec3 half(30, 19.5, 19.125);
  const double t = 6 * std::numbers::pi / 180, mix = std::pow(std::tan(2 * t) / 2, 2);
  const double x2 = half.x() * half.x(), z2 = half.z() * half.z();
  const double product =
      x2 * z2 - mix * (x2 - z2) * (x2 - z2);  // a^2 c^2, the determinant of the cross-section
  const double volume = 4 * std::numbers::pi / 3 * half.y() * std::sqrt(product);
  EXPECT_NEAR(solid_of(mesh).volume, volume, 1e-3 * volume);
  EXPECT_LT((solid_of(mesh).centre - half).norm(), 1e-9);
}

TEST(Bird, HasTheProportionsOfThePaper) {
  const Box box = bounding_box(find_model("bird")->make(64));
  EXPECT_LT(box.lo.cwiseAbs().maxCoeff(), 0.1);
  EXPECT_LT((box.extent() - Vec3(60, 45, 45)).cwiseAbs().maxCoeff(), 0.1);
}

TEST(Bird, IsStarShapedAboutItsCentre) {
  const Vec3 centre = bird_centre();
  ASSERT_GT(bird_field(centre), 0);
  for (const Vec3& u : geodesic_sphere(24).vertices) {
    int changes = 0;
    bool inside = true;
    for (double r = 0.1; r < 60; r += 0.1) {  // mm; the finest feature, the beak, is 8 mm across
      const bool now = bird_field(centre + r * u) > 0;
      changes += now != inside;
      inside = now;
    }
    ASSERT_FALSE(inside);
    ASSERT_EQ(changes, 1) << "direction " << u.transpose();
  }
}

TEST(Bird, HasItsVerticesOnTheSurface) {
  const TriangleMesh mesh = find_model("bird")->make(20);
  for (const Vec3& v : mesh.vertices) {
    const Vec3 u = (v - bird_centre()).normalized();
    EXPECT_GE(bird_field(v - 1e-11 * u), 0);  // marched to 1e-12 mm, points rounded at 60 mm
    EXPECT_LE(bird_field(v + 1e-11 * u), 0);
  }
}

TEST(Bird, IsLopsidedAsASolid) {
  const Solid bird = solid_of(find_model("bird")->make(64));
  const Eigen::Matrix3d ratio = bird.inertia / bird.inertia(0, 0);
  EXPECT_GT(std::abs(ratio(0, 2)), 0.05);
  EXPECT_GT(std::abs(ratio(0, 1)), 0.01);
  EXPECT_GT(std::abs(ratio(1, 2)), 0.01);
}

/// Cells of a grid over the box whose centres lie at least 1.5 cells inside the surface, and the z-columns
/// with such cells. Distances by brute force over the vertices near by, on a mesh finer than the cells.
struct GridCount {
  int cells = 0, columns = 0;
};

GridCount count_cells(const TriangleMesh& mesh, int nx, int ny, int nz, const auto& inside) {
  const Box box = bounding_box(mesh);
  const Vec3 h = box.extent().cwiseQuotient(Vec3(nx, ny, nz));
  const double depth = 1.5 * h.mean();
  const auto cell_of = [&](const Vec3& p, int k) { return int(std::floor((p[k] - box.lo[k]) / h[k])); };
  std::vector<char> near(std::size_t(nx * ny * nz), 0);
  for (const Vec3& v : mesh.vertices)
    for (int i = std::max(0, cell_of(v, 0) - 2); i <= std::min(nx - 1, cell_of(v, 0) + 2); ++i)
      for (int j = std::max(0, cell_of(v, 1) - 2); j <= std::min(ny - 1, cell_of(v, 1) + 2); ++j)
        for (int k = std::max(0, cell_of(v, 2) - 2); k <= std::min(nz - 1, cell_of(v, 2) + 2); ++k) {
          const Vec3 p = box.lo + h.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
          if ((p - v).norm() < depth) near[std::size_t((k * ny + j) * nx + i)] = 1;
        }
  GridCount count;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      int cells = 0;
      for (int k = 0; k < nz; ++k) {
        const Vec3 p = box.lo + h.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
        cells += !near[std::size_t((k * ny + j) * nx + i)] && inside(p);
      }
      count.cells += cells;
      count.columns += cells > 0;
    }
  return count;
}

TEST(Ellipsoid, FillsTheGridAsThePaperCounts) {  // [RayRep, table 2]
  const TriangleMesh mesh = find_model("ellipsoid")->make(90);
  const double t = 6 * std::numbers::pi / 180;
  const double x2 = 900, z2 = 19.125 * 19.125;
  const double xz = 0.5 * std::tan(2 * t) * (x2 - z2);  // the cross-section's mixed term
  Eigen::Matrix3d shape;
  shape << x2, 0, xz, 0, 19.5 * 19.5, 0, xz, 0, z2;
  const Eigen::Matrix3d inverse = shape.inverse();
  const auto inside = [&](const Vec3& p) {
    const Vec3 d = p - Vec3(30, 19.5, 19.125);
    return d.dot(inverse * d) < 1;
  };
  const GridCount count = count_cells(mesh, 80, 52, 51, inside);
  EXPECT_NEAR(count.cells, 94975, 0.02 * 94975);
  EXPECT_NEAR(count.columns, 5882 / 2, 0.01 * 5882 / 2);
}

TEST(Bird, FillsTheGridAsThePaperCounts) {  // [RayRep, table 2]
  const GridCount count =
      count_cells(find_model("bird")->make(90), 80, 60, 60, [](const Vec3& p) { return bird_field(p) > 0; });
  EXPECT_NEAR(count.cells, 100224, 0.03 * 100224);
  EXPECT_NEAR(count.columns, 6184 / 2, 0.03 * 6184 / 2);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
