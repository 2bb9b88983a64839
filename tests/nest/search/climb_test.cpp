#include "nest/search/climb.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nest/known_objectives.hpp"
#include "refusal.hpp"

namespace kreisel::core::nest {
namespace THIS_FILE {

ClimbState climbed(Objective& objective, std::vector<double> x, double value, const ClimbOptions& options) {
  const Climb climb(objective, options);
  ClimbState state = climb.start(std::move(x), value);
  while (climb.step(state)) {
  }
  return state;
}

TEST(Climb, EndsAtTheMaximumOnNumbersDirectionsAndRotations) {
  const double half = std::sqrt(0.5);
  Target target({{Block::number, -1, 1}, {Block::direction}, {Block::rotation}},
                {0.3, 0.6, 0, 0.8, half, 0, half, 0});
  const std::vector<double> x = {0, 0, 0, 1, 1, 0, 0, 0};
  ClimbOptions options;
  options.iterations = 400;
  const ClimbState state = climbed(target, x, target.value(x), options);
  // The last step is 1e-5 of a range or radian in each of seven numbers, and f is the square of the way.
  EXPECT_GT(state.value, -1e-8);
  EXPECT_EQ(state.value, target.value(state.x));
  EXPECT_LT(state.iteration, 400) << "ends by its step, not its limit";
}

/// -|x|^2 in a frame where one axis counts ten thousand times as much as the other, tilted.
class Valley : public Target {
 public:
  Valley() : Target({{Block::number, -2, 2}, {Block::number, -2, 2}}, {0, 0}) {}
  std::vector<double> values(std::span<const double> x, std::span<const double>) override {
    std::vector<double> values;
    for (std::size_t i = 0; i < x.size(); i += 2) values.push_back(at(x[i], x[i + 1]));
    return values;
  }
  static double at(double x, double y) { return -(1e4 * (x + y) * (x + y) + (x - y) * (x - y)); }
};

TEST(Climb, LearnsANarrowValley) {
  Valley valley;
  ClimbOptions options;
  options.iterations = 500;
  options.last_step = 1e-9;
  const ClimbState state = climbed(valley, {1, -0.9}, Valley::at(1, -0.9), options);
  EXPECT_GT(state.value, -1e-8);
  const Eigen::Map<const Eigen::Matrix2d> covariance(state.covariance.data());
  EXPECT_LT(covariance(0, 1) / covariance(0, 0), -0.99) << "its steps lie along the valley";
}

TEST(Climb, GoesOnFromACopyAsIfItHadNeverStopped) {
  Valley valley;
  ClimbOptions options;
  options.iterations = 40;
  const ClimbState whole = climbed(valley, {1, 1}, Valley::at(1, 1), options);
  const Climb climb(valley, options);
  ClimbState state = climb.start({1, 1}, Valley::at(1, 1));
  while (state.iteration < 17) climb.step(state);
  ClimbState resumed = ClimbState(state);
  while (climb.step(resumed)) {
  }
  EXPECT_EQ(resumed.x, whole.x);
  EXPECT_EQ(resumed.covariance, whole.covariance);
}

TEST(Climb, NeverFallsAndRefusesUnfitOptions) {
  Valley valley;
  ClimbOptions options;
  const Climb climb(valley, options);
  ClimbState state = climb.start({0, 0}, 0);
  for (int i = 0; i < 20; ++i) climb.step(state);
  EXPECT_EQ(state.value, 0) << "there is nothing better";
  options.offspring = 0;
  expect_refusal([&] { Climb(valley, options); }, "climb: offspring = 0", {"at least one"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::nest
