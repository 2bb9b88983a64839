#include "nest/search/placement_search.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "nest/inside_ball.hpp"
#include "nest/known_answers.hpp"
#include "refusal.hpp"

namespace kreisel::core::nest {
namespace THIS_FILE {

/// Of a ball in a unit ball that is cut through its centre: 1 - |c|. As a real search, it gives up when that
/// is not above what it is told.
class BallInBall final : public ScaleSearch {
 public:
  std::string_view name() const override { return "ball in ball"; }
  FoundScale search(const Placement& placement, const SearchLimits& limits) override {
    const double scale = std::min(limits.upper, 1 - placement.pose.centroid.norm());
    if (scale <= 0) return {0, false, 1};
    if (scale <= limits.abort_below) return {0, true, 1};
    return {scale, false, 10};
  }
};

Box unit_box() { return {Vec3::Constant(-1), Vec3::Constant(1)}; }

PlacementSpace space_of(std::string_view names, bool with_scale = false) {
  Freedom freedom;
  freedom.set_free(names);
  return {freedom, unit_box(), with_scale, 1};
}

PlacementSearchOptions options_of(int iterations) {
  PlacementSearchOptions options;
  options.swarm.particles = 40;
  options.swarm.iterations = iterations;
  options.swarm.momentum = Momentum::constriction;
  options.climb.iterations = 100;
  return options;
}

SearchState searched(PlacementObjective& objective, const PlacementSearchOptions& options) {
  const PlacementSearch search(objective, options);
  SearchState state = search.start();
  while (search.step(state)) {
  }
  return state;
}

TEST(PlacementSpace, HasTheFreedomsThatAreNamed) {
  EXPECT_EQ(space_of("all").space().freedom(), 3 + 3 + 2 + 1 + 2 * 2);
  EXPECT_EQ(space_of("all", true).space().freedom(), 14);
  EXPECT_EQ(space_of("upright,position").space().size(), 4 + 3);
  EXPECT_EQ(space_of("centroid-plane").space().size(), 3);
  EXPECT_EQ(space_of("none").space().size(), 0);
  expect_refusal([] { (void)space_of("rotation,upright"); }, "free 'upright' has both", {"one of them"});
  expect_refusal([] { (void)space_of("rotatoin"); }, "free part 'rotatoin' is unknown", {"rotation"});
}

TEST(PlacementSpace, MakesPlacementsThatAreValidFromAnyNumbers) {
  const PlacementSpace space = space_of("all", true);
  for (int i = 0; i < 200; ++i) {
    std::vector<double> x;
    for (int k = 0; k < space.space().size(); ++k)
      x.push_back(4 * std::sin(37.0 * i + 11.0 * k * k) - 1);  // scattered, far out
    space.project(x);
    Placement placement = space.placement(x);
    placement.pose.scale = std::max(placement.pose.scale, 1e-3);
    EXPECT_NO_THROW(require_valid(placement)) << i;
    EXPECT_GE(placement.cut.plus.dot(placement.cut.normal), PlacementSpace::least_slope);
    EXPECT_LE(placement.cut.minus.dot(placement.cut.normal), -PlacementSpace::least_slope);
  }
}

TEST(PlacementSpace, FindsThePositionOfAPlacementAgain) {
  const PlacementSpace space = space_of("all", true);
  std::vector<double> unit, x(static_cast<std::size_t>(space.space().size()));
  for (int k = 0; k < space.space().freedom(); ++k) unit.push_back(0.9 * std::abs(std::sin(k + 1.0)));
  space.place(unit, x);
  const std::vector<double> again = space.position(space.placement(x));
  std::vector<double> way(x.size());
  space.space().towards(x, again, way);
  for (const double difference : way) EXPECT_NEAR(difference, 0, 1e-12);
}

TEST(PlacementSpace, KeepsAnUprightShapeUpright) {
  Freedom freedom;
  freedom.set_free("upright");
  freedom.up = Vec3(0.6, 0, 0.8);
  const PlacementSpace space(freedom, unit_box(), false, 1);
  std::vector<double> x = {0.3, -0.8, 0.4, 0.2};
  space.project(x);
  const Eigen::Matrix3d rotation = space.placement(x).pose.rotation;
  EXPECT_NEAR((rotation * freedom.up - freedom.up).norm(), 0, 1e-14);
  EXPECT_GT((rotation - Eigen::Matrix3d::Identity()).norm(), 0.1) << "turned all the same";
}

TEST(PlacementSpace, TiedPlanesAndDirectionsFollow) {
  const PlacementSpace space = space_of("position,centroid-plane");
  std::vector<double> x = {0.1, 0.2, 0.3, 0, 3, 4};
  space.project(x);
  const Placement placement = space.placement(x);
  EXPECT_NEAR(placement.cut.beyond(0, Vec3(0.1, 0.2, 0.3)), 0, 1e-15);
  EXPECT_EQ(placement.cut.plus, placement.cut.normal);
  EXPECT_EQ(placement.cut.minus, -placement.cut.normal);
}

TEST(PlacementSearch, FindsTheLargestBallInABall) {
  BallInBall search;
  LargestScale objective(space_of("all"), {}, search, 1, 1e-4, true);
  const SearchState state = searched(objective, options_of(150));
  EXPECT_EQ(state.phase, SearchState::over);
  // The climb ends when its steps are under 1e-5 of the box's two units; the scale falls by as much.
  EXPECT_GT(state.scale, 1 - 1e-4);
  EXPECT_GT(objective.aborted(), 0u);
  EXPECT_EQ(state.trace.back().best, state.scale);
}

TEST(PlacementSearch, GivesUpNoSearchThatWouldHaveMattered) {
  BallInBall search;
  LargestScale eager(space_of("all"), {}, search, 1, 1e-4, true);
  LargestScale patient(space_of("all"), {}, search, 1, 1e-4, false);
  const SearchState one = searched(eager, options_of(60)), other = searched(patient, options_of(60));
  EXPECT_EQ(one.scale, other.scale);
  EXPECT_EQ(one.best, other.best);
  EXPECT_EQ(patient.aborted(), 0u);
}

TEST(PlacementSearch, TakesTheScaleAsANumberLikeOthers) {
  InsideBall feasibility;
  ScaleInPosition objective(space_of("position", true), {}, feasibility);
  PlacementSearchOptions options = options_of(300);
  const SearchState state = searched(objective, options);
  // A hard constraint leaves a swarm nothing to go by but its members: a percent.
  EXPECT_GT(state.scale, 0.99);
  const PlacementSearch search(objective, options);
  EXPECT_TRUE(feasibility.check(search.best(state)).valid());
}

TEST(PlacementSearch, GoesOnFromACopyAsIfItHadNeverStopped) {
  BallInBall search;
  LargestScale objective(space_of("all"), {}, search, 1, 1e-4, true);
  const PlacementSearchOptions options = options_of(20);
  const SearchState whole = searched(objective, options);
  for (const int stop : {7, 21, 40}) {  // in the swarm, between, in the climb
    const PlacementSearch first(objective, options);
    SearchState state = first.start();
    for (int i = 0; i < stop; ++i) first.step(state);
    SearchState resumed = state;
    while (first.step(resumed)) {
    }
    EXPECT_EQ(resumed.best, whole.best) << stop;
    EXPECT_EQ(resumed.evaluations(), whole.evaluations()) << stop;
  }
}

TEST(KeepOut, ForbidsPlanesThatPartTheSurfaceInABall) {
  const Nesting nesting(ball(8), ball(8));
  const Vec3 top = nesting.to_units(Vec3::UnitZ());
  const KeepOuts keep_outs(nesting, {{top, 0.2}});
  EXPECT_TRUE(keep_outs.touched(Cut::through(top, Vec3::UnitX())));
  EXPECT_FALSE(keep_outs.touched(Cut::through(Vec3::Zero(), Vec3::UnitZ())));
  EXPECT_FALSE(KeepOuts().touched(Cut::through(top, Vec3::UnitX())));
  expect_refusal([&] { KeepOuts(nesting, {{top, -1}}); }, "keep-out of radius", {"> 0"});
  expect_refusal([&] { KeepOuts(nesting, {{Vec3::Zero(), 0.1}}); }, "keep-out at", {"no vertex"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::nest
