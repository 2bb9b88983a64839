#include "deform/handle_motion.hpp"

#include <gtest/gtest.h>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Four handles that make every affine motion: x -> x + u0 + x u1 + y u2 + z u3.
class Affine final : public Handles {
 public:
  [[nodiscard]] std::size_t count() const override { return 4; }
  [[nodiscard]] HandleWeights at(const Vec3& x) const override {
    return {
        {0, 1, Vec3::Zero()}, {1, x[0], Vec3::UnitX()}, {2, x[1], Vec3::UnitY()}, {3, x[2], Vec3::UnitZ()}};
  }
  [[nodiscard]] Eigen::MatrixXd bending() const override { return Eigen::MatrixXd::Zero(4, 4); }
};

Eigen::MatrixX3d random_u(Random& random, Eigen::Index handles, double most) {
  return Eigen::MatrixX3d::NullaryExpr(handles, 3, [&] { return uniform(random, -most, most); });
}

TEST(HandleMotion, LeavesItsAnchorWhereItIsAndMovesAllElseAffinely) {
  const TriangleMesh box = box_mesh({-1, -1, -1}, {1, 2, 3});
  const Vec3 anchor(0.3, 0.2, -1);
  Random random(1);
  const HandleMotion motion(box, Affine(), anchor);
  const Eigen::MatrixX3d u = random_u(random, 4, 0.3);
  const Eigen::Matrix3d A = Eigen::Matrix3d::Identity() + u.bottomRows<3>().transpose();
  const TriangleMesh moved = motion.moved(u);
  for (std::size_t i = 0; i < box.vertices.size(); ++i)
    EXPECT_LT((moved.vertices[i] - (anchor + A * (box.vertices[i] - anchor))).norm(), 1e-14);
  EXPECT_LT((motion.row(5) * u - motion.displacement(u).row(5)).norm(), 1e-14);
}

TEST(HandleMotion, PullsBackWhatIsAlongItsDisplacement) {
  const TriangleMesh box = box_mesh({-1, -1, -1}, {1, 2, 3});
  Random random(2);
  const HandleMotion motion(box, Affine(), Vec3(0.1, 0, 0.5));
  const Eigen::MatrixX3d u = random_u(random, 4, 1);
  std::vector<Vec3> force;
  for (std::size_t i = 0; i < box.vertices.size(); ++i) force.push_back(random_vec(random, -1, 1));
  const Eigen::MatrixX3d d = motion.displacement(u);
  double work = 0;
  for (std::size_t i = 0; i < force.size(); ++i) work += force[i].dot(d.row(static_cast<Eigen::Index>(i)));
  EXPECT_NEAR(motion.pulled_back(force).cwiseProduct(u).sum(), work, 1e-12);
}

TEST(Determinants, AreThoseOfTheAffineMotion) {
  Random random(3);
  const Determinants determinants({Vec3(1, 2, 3), Vec3::Zero()}, Affine());
  const Eigen::MatrixX3d u = random_u(random, 4, 0.5);
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
  A += u.bottomRows<3>().transpose();
  const double want = A.determinant();
  EXPECT_NEAR(determinants.at(0, u), want, 1e-14);
  EXPECT_NEAR(determinants.least(u), want, 1e-14);
  const double h = 1e-5;
  const Eigen::MatrixX3d slope = determinants.gradient(1, u);
  for (Eigen::Index k = 0; k < 4; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::MatrixX3d more = u, less = u;
      more(k, axis) += h;
      less(k, axis) -= h;
      // A determinant is linear in each entry.
      EXPECT_NEAR(slope(k, axis), (determinants.at(1, more) - determinants.at(1, less)) / (2 * h), 1e-9);
    }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
