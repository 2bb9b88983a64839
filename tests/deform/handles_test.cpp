#include "deform/handles.hpp"

#include <gtest/gtest.h>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

std::vector<Vec3> cloud(std::size_t n) {
  Random random(11);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i)
    points.push_back(random_vec(random, -1, 1).cwiseProduct(Vec3(1, 0.6, 0.8)));
  return points;
}

double weight_of(const HandleWeights& all, std::uint32_t handle) {
  for (const HandleWeight& w : all)
    if (w.handle == handle) return w.weight;
  return 0;
}

void expect_gradients(const Handles& handles, const std::vector<Vec3>& points) {
  const double h = 1e-5;
  for (const Vec3& p : points)
    for (const HandleWeight& w : handles.at(p))
      for (int axis = 0; axis < 3; ++axis) {
        const double more = weight_of(handles.at(p + h * Vec3::Unit(axis)), w.handle),
                     less = weight_of(handles.at(p - h * Vec3::Unit(axis)), w.handle);
        // Third derivatives of weights are below 1e3 for these spans: h^2 / 6 of them.
        EXPECT_NEAR(w.gradient[axis], (more - less) / (2 * h), 2e-8);
      }
}

TEST(Lattice, HasWeightsThatSumToOneAndRunSmoothly) {
  const std::vector<Vec3> points = cloud(4000);
  const Lattice lattice(points, 4);
  EXPECT_GT(lattice.count(), 100u);
  for (std::size_t i = 0; i < points.size(); i += 37) {
    double sum = 0;
    Vec3 slope = Vec3::Zero();
    for (const HandleWeight& w : lattice.at(points[i])) sum += w.weight, slope += w.gradient;
    // Handles that weigh less than 1e-3 everywhere are left out.
    EXPECT_NEAR(sum, 1, 0.03);
    EXPECT_LT(slope.norm(), 0.3);
  }
  expect_gradients(lattice, {points.begin(), points.begin() + 20});
}

TEST(Lattice, DoesNotBendInAMotionThatIsAffine) {
  const Lattice lattice(cloud(4000), 3);
  const Eigen::MatrixXd bending = lattice.bending();
  const auto n = static_cast<Eigen::Index>(lattice.count());
  EXPECT_NEAR((bending * Eigen::VectorXd::Ones(n)).norm(), 0, 1e-12);
  EXPECT_NEAR((bending - bending.transpose()).norm(), 0, 1e-12);
  Random random(3);
  const Eigen::VectorXd u = Eigen::VectorXd::NullaryExpr(n, [&] { return uniform(random, -1, 1); });
  EXPECT_GT(u.dot(bending * u), 0);
}

TEST(HeldHandles, LeaveWhatIsHeldWhereItIs) {
  const std::vector<Vec3> points = cloud(2000);
  std::vector<std::unique_ptr<Held>> parts;
  parts.push_back(held_ball({0.2, 0, 0}, 0.2, 0.3));
  parts.push_back(held_below(-0.5, 0.2));
  parts.push_back(held_about_axis(0.05, 0.1));
  parts.push_back(held_inside(box_mesh({-0.9, -0.5, 0.3}, {-0.5, 0.5, 0.6}), 0.01, 0.2));
  const HeldHandles handles(std::make_unique<Lattice>(points, 4), held_together(std::move(parts)));
  int held = 0;
  for (const Vec3& p : points) {
    const bool kept = (p - Vec3(0.2, 0, 0)).norm() < 0.2 || p[2] < -0.5 || p.head<2>().norm() < 0.05 ||
                      (p[0] > -0.9 && p[0] < -0.5 && std::abs(p[1]) < 0.5 && p[2] > 0.3 && p[2] < 0.6);
    if (!kept) continue;
    ++held;
    double moves = 0;
    for (const HandleWeight& w : handles.at(p)) moves = std::max(moves, std::abs(w.weight));
    EXPECT_EQ(moves, 0.0);
  }
  EXPECT_GT(held, 100);
  expect_gradients(handles, {points.begin(), points.begin() + 40});
}

TEST(Held, FadesInFromNothingToAll) {
  const auto ball = held_ball(Vec3::Zero(), 1, 0.5);
  EXPECT_EQ(ball->at({0.99, 0, 0}).value, 0.0);
  EXPECT_NEAR(ball->at({1.25, 0, 0}).value, 0.5, 1e-12);
  EXPECT_EQ(ball->at({0, 1.51, 0}).value, 1.0);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
