#include "deform/cage_handles.hpp"

#include <gtest/gtest.h>

#include "deform/bodies.hpp"
#include "deform/handle_motion.hpp"

namespace kreisel::core {
namespace THIS_FILE {

std::shared_ptr<const WeightedCage> of_ellipsoid() {
  return weighted_cage(leaning_ellipsoid({3, 4, 8}, 30, 24), 2, 4);
}

TEST(CageHandles, MoveAllAlikeWhenAllMoveAlike) {
  const auto cage = of_ellipsoid();
  const CageHandles handles(cage);
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    double sum = 0;
    Vec3 slope = Vec3::Zero();
    for (const HandleWeight& w : handles.at(random_vec(random, -6, 6))) sum += w.weight, slope += w.gradient;
    EXPECT_NEAR(sum, 1, 1e-8);
    EXPECT_LT(slope.norm(), 1e-8);
  }
}

TEST(CageHandles, GoWithTheirOwnCornerAlone) {
  const auto cage = of_ellipsoid();
  const CageHandles handles(cage);
  for (std::uint32_t j = 0; j < handles.count(); ++j)
    for (const HandleWeight& w : handles.at(cage->cage.position(cage->cage.nodes()[cage->cage.handles()[j]])))
      EXPECT_NEAR(w.weight, w.handle == j ? 1 : 0, 1e-12);
}

TEST(CageHandles, HaveTheGradientsOfTheirWeights) {
  const CageHandles handles(of_ellipsoid());
  const Vec3 x(0.31, -0.57, 1.13);  // within a cell of the grid, with all around it
  const double h = 1e-4;            // weights are tri-linear there
  const auto weight_at = [&](const Vec3& at, std::uint32_t handle) {
    for (const HandleWeight& w : handles.at(at))
      if (w.handle == handle) return w.weight;
    return 0.0;
  };
  for (const HandleWeight& w : handles.at(x))
    for (int a = 0; a < 3; ++a)
      EXPECT_NEAR(
          w.gradient[a],
          (weight_at(x + h * Vec3::Unit(a), w.handle) - weight_at(x - h * Vec3::Unit(a), w.handle)) / (2 * h),
          1e-9);
}

TEST(CageHandles, OfASymmetricBodyAreSymmetric) {
  // Its own mirror image in y, and so are the cage and the weights.
  const auto cage = of_ellipsoid();
  const CageHandles handles(cage);
  const auto place = [&](std::uint32_t j) {
    return cage->cage.position(cage->cage.nodes()[cage->cage.handles()[j]]);
  };
  const Vec3 x(1.3, 1.7, -2.1), mirrored(1.3, -1.7, -2.1);
  const HandleWeights one = handles.at(x), other = handles.at(mirrored);
  for (const HandleWeight& w : one)
    for (const HandleWeight& m : other)
      if ((place(w.handle) - Vec3(1, -1, 1).cwiseProduct(place(m.handle))).norm() < 1e-9) {
        EXPECT_NEAR(w.weight, m.weight, 1e-4);
      }
}

TEST(CageHandles, DoNotBendWhenAllMoveAlike) {
  const CageHandles handles(of_ellipsoid());
  const Eigen::MatrixXd bending = handles.bending();
  const auto n = static_cast<Eigen::Index>(handles.count());
  EXPECT_NEAR((bending * Eigen::VectorXd::Ones(n)).norm(), 0, 1e-9);
  EXPECT_NEAR((bending - bending.transpose()).norm(), 0, 1e-9);
  EXPECT_GT(bending(0, 0), 0);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
