#include "body/mesh_moments.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "body/test_meshes.hpp"
#include "mesh/solid/check.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class MeshMomentsOn : public testing::TestWithParam<bool> {
 protected:
  device::Device& device() { return GetParam() ? single_device() : test_device(); }

  /// What a mesh away from the origin may be wrong by: the bound at the middle of its box, moved like a
  /// solid's moments but with absolute values, and the roundings of the move itself.
  Moments tolerance(const TriangleMesh& mesh) {
    const Box box = bounding_box(mesh);
    const Vec3 middle = (box.lo + box.hi) / 2;
    const Moments abs_sum =
        reference::mesh_moments(moved(mesh, Eigen::Matrix3d::Identity(), -middle)).abs_sum;
    const Moments reach = transformed(abs_sum, Eigen::Matrix3d::Identity(), middle.cwiseAbs());
    return (mesh_moments_bound(mesh, device()) + 16 * 0x1p-53) * reach;
  }
};

void expect_near(const Moments& got, const Moments& want, const Moments& tolerance) {
  for (int k = 0; k < 10; ++k) EXPECT_LE(std::abs(got[k] - want[k]), tolerance[k]) << moment_names[k];
}

TEST_P(MeshMomentsOn, StayWithinTheBoundOfTheReference) {
  // One triangle, one work-group and its borders, several blocks; primes hit no boundary by accident.
  for (const std::size_t n : {1u, 2u, 7u, 63u, 64u, 65u, 997u, 1024u, 1025u, 7919u}) {
    SCOPED_TRACE(n);
    const TriangleMesh soup = triangle_soup(n, 100 + n);
    const auto want = reference::mesh_moments(soup);
    // The soup's box is centred at the origin, so nothing is moved and the stated bound stands alone. The
    // reference rounds too, by some sqrt(n) units of which the worst-case bound holds more than enough.
    expect_near(mesh_moments(soup, device()), want.value, mesh_moments_bound(soup, device()) * want.abs_sum);
  }
}

TEST_P(MeshMomentsOn, OfACubeHaveTheClosedFormWhereverItStands) {
  for (const Vec3& lo : {Vec3(-0.5, -0.5, -0.5), Vec3(0, 0, 0), Vec3(3, -2, 5.25)}) {
    const Vec3 edges(1, 2, 0.5);
    const TriangleMesh box = box_mesh(lo, lo + edges);
    expect_near(mesh_moments(box, device()), box_moments(lo + edges / 2, edges), tolerance(box));
  }
}

TEST_P(MeshMomentsOn, OfAnInsideOutMeshAreNegative) {
  TriangleMesh box = box_mesh({-1, -1, -1}, {1, 1, 2});
  for (Triangle& t : box.triangles) std::swap(t[0], t[1]);
  expect_near(mesh_moments(box, device()), -box_moments({0, 0, 0.5}, {2, 2, 3}), tolerance(box));
}

TEST_P(MeshMomentsOn, RepeatAgreesBitForBit) {
  const TriangleMesh soup = triangle_soup(7919, 9);
  const Moments first = mesh_moments(soup, device());
  for (int repeat = 0; repeat < 3; ++repeat)
    for (int k = 0; k < 10; ++k) EXPECT_EQ(mesh_moments(soup, device())[k], first[k]) << moment_names[k];
}

TEST_P(MeshMomentsOn, OfAnEmptyMeshAreExactlyZero) {
  EXPECT_EQ(mesh_moments({}, device()), Moments(Moments::Zero()));
  EXPECT_EQ(mesh_moments({{Vec3(1, 2, 3)}, {}}, device()), Moments(Moments::Zero()));
}

TEST_P(MeshMomentsOn, BoundIsAFewDozenRoundings) {
  // No tolerance may hide a wrong coefficient: the bound stays far below one in a thousand.
  for (const std::size_t n : {1u, 7919u, 1000003u}) {
    TriangleMesh mesh;
    mesh.triangles.resize(n);
    const double bound = mesh_moments_bound(mesh, device());
    EXPECT_GT(bound, 40 * device().unit_roundoff());
    EXPECT_LT(bound, device().single() ? 4e-6 : 4e-13);
  }
}

INSTANTIATE_TEST_SUITE_P(BothPrecisions, MeshMomentsOn, testing::Bool(),
                         [](const auto& p) { return p.param ? "single" : "standard"; });

/// A handful of triangles: 64 roundings of the sum of absolute terms.
void expect_reference(const TriangleMesh& mesh, const Moments& want) {
  const auto got = reference::mesh_moments(mesh);
  expect_near(got.value, want, 64 * 0x1p-53 * got.abs_sum);
}

TEST(MeshMomentsReference, OfTheUnitTetrahedronAreTheSimplexIntegrals) {
  // Integral of x^a y^b z^c over the unit simplex: a! b! c! / (a+b+c+3)!
  Moments want;
  want << 1 / 6.0, 1 / 24.0, 1 / 24.0, 1 / 24.0, 1 / 120.0, 1 / 120.0, 1 / 120.0, 2 / 120.0, 2 / 120.0,
      2 / 120.0;
  const TriangleMesh mesh = tetrahedron_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  expect_reference(mesh, want);
  const Vec3 shift(2, -3, 0.5);
  expect_reference(moved(mesh, Eigen::Matrix3d::Identity(), shift),
                   transformed(want, Eigen::Matrix3d::Identity(), shift));
}

TEST(MeshMomentsReference, OfABoxAreItsClosedForm) {
  expect_reference(box_mesh({-1, -2, -3}, {1, 2, 3}), box_moments(Vec3::Zero(), {2, 4, 6}));
  expect_reference(box_mesh({1, 2, 3}, {1.5, 4, 7}), box_moments({1.25, 3, 5}, {0.5, 2, 4}));
}

TEST(MeshMomentsReference, OfTheLetterCAreThreeBoxes) {
  const TriangleMesh mesh = letter_c_mesh(2);
  ASSERT_NO_THROW(require_solid(mesh, "C"));
  expect_reference(mesh, box_moments({1.5, 1, 0.5}, {3, 2, 1}) + box_moments({0.5, 1, 1.5}, {1, 2, 1}) +
                             box_moments({1.5, 1, 2.5}, {3, 2, 1}));
}

TEST(MeshMomentsReference, AbsoluteSumsBoundTheValues) {
  const auto sums = reference::mesh_moments(triangle_soup(97, 1));
  for (int k = 0; k < 10; ++k) EXPECT_GE(sums.abs_sum[k], std::abs(sums.value[k])) << moment_names[k];
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
