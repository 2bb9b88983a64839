#include "deform/moved_cells.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "body/mesh_moments.hpp"
#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// 8 x 8 x 4 voxels of 1/4 in a cage of cells of 1; the grid's cells have two voxels along an edge.
struct Block {
  TriangleMesh mesh = box_mesh({-1, -1, 2}, {1, 1, 3});
  Cage cage{mesh, {Vec3(-1, -1, 2), 1, {2, 2, 1}, 2}};
  Columns domain;

  Block() {
    domain.grid.n = {8, 8, 4};
    domain.grid.origin = Vec3(-1, -1, 2);
    domain.grid.h = 0.25;
    for (std::uint16_t iy = 0; iy < 8; ++iy)
      for (std::uint16_t ix = 0; ix < 8; ++ix) domain.intervals.push_back({ix, iy, 0, 4});
  }
  [[nodiscard]] NodeMotion motion(const std::function<Eigen::RowVector3d(const Vec3&)>& of) const {
    NodeMotion all(static_cast<Eigen::Index>(cage.nodes().size()), 3);
    for (std::size_t n = 0; n < cage.nodes().size(); ++n)
      all.row(static_cast<Eigen::Index>(n)) = of(cage.position(cage.nodes()[n]));
    return all;
  }
};

NodeMotion any_motion(const Block& block, double size) {
  Random random(17);
  return block.motion([&](const Vec3&) {
    return Eigen::RowVector3d::NullaryExpr([&] { return uniform(random, -size, size); });
  });
}

TEST(MovedCells, StayWhatTheyAreWhereNothingMoves) {
  const Block block;
  MovedCells cells(block.cage, block.domain);
  const std::vector<Cube> cubes = {{0, 0, 0, 4}, {4, 0, 0, 2}, {6, 2, 3, 1}};
  cells.set(cubes);
  const auto s = cells.moments(
      block.motion([](const Vec3&) -> Eigen::RowVector3d { return Eigen::RowVector3d::Zero(); }));
  for (std::size_t c = 0; c < cubes.size(); ++c) {
    const double edge = 0.25 * cubes[c].edge;
    const Vec3 corner = Vec3(-1, -1, 2) + 0.25 * Vec3(cubes[c].x, cubes[c].y, cubes[c].z);
    const Moments want = box_moments(corner + Vec3::Constant(edge / 2), Vec3::Constant(edge));
    EXPECT_LT((s.col(static_cast<Eigen::Index>(c)) - want).norm(), 1e-13);
  }
}

TEST(MovedCells, OfAnAffineMotionHaveItsClosedForm) {
  // x goes to A x + b.
  const Block block;
  Eigen::Matrix3d shear;
  shear << 0.3, 0.1, -0.2, 0.3, 0.2, 0.05, -0.1, 0.2, 0.1;
  const Vec3 b(0.3, -0.2, 0.7);
  const NodeMotion motion = block.motion([&](const Vec3& x) -> Eigen::RowVector3d { return shear * x + b; });
  MovedCells cells(block.cage, block.domain);
  cells.set(std::vector<Cube>{{0, 0, 0, 8}});
  const Moments got = cells.moments(motion).col(0);
  TriangleMesh moved = block.mesh;
  for (Vec3& v : moved.vertices) v += shear * v + b;
  const Moments want = reference::mesh_moments(moved).value;
  EXPECT_LT((got - want).norm(), 1e-13 * want.norm());
}

TEST(MovedCells, AreTheSumOfTheirParts) {
  const Block block;
  const NodeMotion motion = any_motion(block, 0.05);
  MovedCells cells(block.cage, block.domain);
  cells.set(std::vector<Cube>{{0, 0, 0, 8}});
  const Moments whole = cells.moments(motion).col(0);
  cells.set(uniform_cubes(block.domain.grid, 1));
  ASSERT_EQ(cells.size(), 256u);
  const Moments parts = cells.moments(motion).rowwise().sum();
  EXPECT_LT((whole - parts).norm(), 1e-13 * whole.norm());
}

TEST(MovedCells, HaveTheDerivativesOfTheirMoments) {
  const Block block;
  const NodeMotion motion = any_motion(block, 0.05);
  MovedCells cells(block.cage, block.domain);
  cells.set(std::vector<Cube>{{0, 0, 0, 4}, {4, 4, 0, 2}, {7, 3, 1, 1}});
  const std::vector<double> fill = {0.3, 0.9, 0.6};
  const std::vector<Moments> q = {Moments(Moments::LinSpaced(-1, 2)), Moments(Moments::LinSpaced(1, 0.5))};
  const std::vector<NodeMotion> gradient = cells.gradient(motion, fill, q);
  Random random(2);
  const NodeMotion along = NodeMotion::NullaryExpr(motion.rows(), 3, [&] { return uniform(random, -1, 1); });
  const Eigen::Map<const Eigen::VectorXd> fills(fill.data(), 3);
  const auto value = [&](double t) -> Moments { return cells.moments(motion + t * along) * fills; };
  const double h = 1e-4;
  const Moments slope = (value(h) - value(-h)) / (2 * h);
  for (std::size_t r = 0; r < q.size(); ++r)
    EXPECT_NEAR(gradient[r].cwiseProduct(along).sum(), q[r].dot(slope), 1e-7 * std::abs(q[r].dot(slope)));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
