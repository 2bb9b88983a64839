#include "nest/search/space.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "nest/decide/random.hpp"

namespace kreisel::core::nest {
namespace THIS_FILE {

const Space mixed({{Block::number, -2, 5}, {Block::direction}, {Block::rotation}});

TEST(Space, CountsNumbersFreedomsAndSteps) {
  EXPECT_EQ(mixed.size(), 1 + 3 + 4);
  EXPECT_EQ(mixed.freedom(), 1 + 2 + 3);
  EXPECT_EQ(mixed.steps(), 1 + 3 + 3);
}

TEST(Space, ProjectsToRangesAndUnitLengthAndMendsNothingness) {
  std::array<double, 8> x = {7, 0, 3, 4, 2, 0, 0, 0};
  mixed.project(x);
  EXPECT_EQ(x, (std::array<double, 8>{5, 0, 0.6, 0.8, 1, 0, 0, 0}));
  std::array<double, 8> nothing{};
  mixed.project(nothing);
  EXPECT_EQ(nothing, (std::array<double, 8>{0, 1, 0, 0, 1, 0, 0, 0}));
}

TEST(Space, GoesTheShortWayBetweenRotations) {
  const Space rotations(std::vector<Block>{{Block::rotation}});
  const std::array<double, 4> x = {1, 0, 0, 0}, same = {-1, 0, 0, 0};
  std::array<double, 4> way{};
  rotations.towards(x, same, way);
  for (const double component : way) EXPECT_EQ(component, 0) << "q and -q are one rotation";
}

// The mean of z^2 over uniform directions is 1/3, that of w^2 over uniform rotations 1/4. With n samples the
// means scatter by their standard deviation, 0.3 / sqrt(n); five of those are allowed.
TEST(Space, PlacesUniformNumbersUniformly) {
  constexpr int n = 4000;
  double z2 = 0, w2 = 0, number = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = 0; i < n; ++i) {
    std::array<double, 6> unit;
    for (std::size_t k = 0; k < unit.size(); ++k) unit[k] = uniform(3, static_cast<std::uint64_t>(i), k);
    std::array<double, 8> x;
    mixed.place(unit, x);
    number += x[0] / n;
    z2 += x[3] * x[3] / n;
    w2 += x[4] * x[4] / n;
    mean += Eigen::Vector3d(x[1], x[2], x[3]) / n;
    EXPECT_NEAR(Eigen::Vector4d(x[4], x[5], x[6], x[7]).norm(), 1, 1e-14);
  }
  const double scatter = 5 * 0.3 / std::sqrt(n);
  EXPECT_NEAR(number, 1.5, 7 * scatter);
  EXPECT_NEAR(z2, 1.0 / 3, scatter);
  EXPECT_NEAR(w2, 0.25, scatter);
  EXPECT_LT(mean.norm(), 2 * scatter);
}

TEST(Space, MovesByTurnsWhoseAngleIsTheStep) {
  std::array<double, 8> x = {0, 0, 0, 1, 1, 0, 0, 0};
  const std::array<double, 7> step = {0.1, 0.2, 0, 0, 0, 0, 0.3};
  mixed.move(step, x);
  EXPECT_NEAR(x[0], 0.7, 1e-15) << "a tenth of the range";
  EXPECT_NEAR(x[3], std::cos(0.2), 1e-15);
  EXPECT_NEAR(x[2], -std::sin(0.2), 1e-15) << "z turned about x goes to -y";
  EXPECT_NEAR(x[4], std::cos(0.15), 1e-15);
  EXPECT_NEAR(x[7], std::sin(0.15), 1e-15);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::nest
