#include "body/models/implicit_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "body/mesh_solid.hpp"
#include "body/models/blend.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double pi = std::numbers::pi;
const Box around{Vec3::Constant(-1.5), Vec3::Constant(1.5)};

double ball(const Vec3& p) { return p.norm() - 1; }

double torus(const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()) - 0.4; }

TEST(ImplicitMesh, OfABallHasItsVerticesOnTheSphereAndFacesOut) {
  const TriangleMesh mesh = mesh_of(ball, around, 0.2);
  EXPECT_NO_THROW(require_solid(mesh, "ball"));
  for (const Vec3& v : mesh.vertices) ASSERT_NEAR(v.norm(), 1, 1e-13);
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    ASSERT_GT((b - a).cross(c - a).normalized().dot((a + b + c).normalized()), 0.9)
        << "a triangle turned over";
  }
}

TEST(ImplicitMesh, IsSecondOrderAccurate) {
  const auto error = [](const ScalarField& field, double exact, double cell) {
    return exact - solid_of(mesh_of(field, around, cell)).volume;
  };
  EXPECT_NEAR(error(ball, 4 * pi / 3, 0.2) / error(ball, 4 * pi / 3, 0.1), 4, 0.3);
  const double tube = 2 * pi * pi * 0.4 * 0.4;
  EXPECT_NEAR(error(torus, tube, 0.2) / error(torus, tube, 0.1), 4, 0.5);
}

TEST(ImplicitMesh, OfATorusHasOneHole) {
  const TriangleMesh mesh = mesh_of(torus, around, 0.15);
  EXPECT_EQ(mesh.vertices.size(), mesh.triangles.size() / 2);
}

TEST(ImplicitMesh, IsManifoldEvenOfNoise) {
  // Far coarser than the waves: cells are cut at random, and the mesh must still close.
  const ScalarField noise = [](const Vec3& p) {
    return std::max(p.norm() - 1.2, std::sin(41 * p.x()) + std::sin(37 * p.y()) + std::sin(43 * p.z()));
  };
  const MeshReport report = inspect(mesh_of(noise, around, 0.11));
  EXPECT_TRUE(report.watertight());
  EXPECT_TRUE(report.oriented());
}

TEST(ImplicitMesh, RefusesASolidThatLeavesItsBox) {
  EXPECT_THROW((void)mesh_of(ball, {Vec3::Constant(-0.5), Vec3::Constant(0.5)}, 0.1), std::logic_error);
}

TEST(Blend, ConeIsTheDistanceToTheHullOfTwoBalls) {
  const Vec3 a(0, 0, 0), b(0, 0, 4);
  EXPECT_NEAR(blend::cone(Vec3(0, 0, -5), a, 2, b, 1), 3, 1e-15);
  EXPECT_NEAR(blend::cone(Vec3(0, 0, 7), a, 2, b, 1), 2, 1e-15);
  // A point on the common tangent: its normal leans by asin((2 - 1) / 4).
  const Vec3 normal(std::sqrt(15.0) / 4, 0, 0.25), between = 0.5 * ((a + 2 * normal) + (b + normal));
  EXPECT_NEAR(blend::cone(between, a, 2, b, 1), 0, 1e-15);
  EXPECT_NEAR(blend::cone(between + 0.7 * normal, a, 2, b, 1), 0.7, 1e-15);
}

TEST(Blend, JoinFillsTheSeamByAQuarterOfItsWidthAndNothingBeyond) {
  EXPECT_EQ(blend::join(1, 1, 0.4), 0.9);
  EXPECT_EQ(blend::join(1, 1.4, 0.4), 1);
  EXPECT_EQ(blend::meet(1, 1, 0.4), 1.1);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
