#include "nest/search/optimise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "mesh/query/surface_rays.hpp"
#include "nest/decide/exact.hpp"
#include "nest/known_answers.hpp"
#include "refusal.hpp"
#include "test_device.hpp"

namespace kreisel::core::nest {
namespace THIS_FILE {

OptimiseSpec quick(std::string_view free) {
  OptimiseSpec spec;
  spec.freedom.set_free(free);
  spec.search.swarm.particles = 20;
  spec.search.swarm.iterations = 25;
  spec.search.swarm.momentum = Momentum::constriction;
  spec.search.climb.iterations = 60;
  return spec;
}

/// A sphere in an ellipsoid with half-axes 1.5, 1.2 and 1, off its centre at first. The best is its centre,
/// cut through it: the smallest half-axis, whichever way.
const Nesting& egg() {
  static const Nesting nesting(ball(6, {1.5, 1.2, 1}), ball(6));
  return nesting;
}

TEST(Optimise, FindsTheLargestSphereInAnEllipsoidAndItNestsExactly) {
  const OptimiseSpec spec = quick("all");
  const OptimiseResult result = optimise(egg(), test_device(), spec);
  ASSERT_TRUE(result.best);
  EXPECT_FALSE(result.ended_early);
  EXPECT_TRUE(Exact(egg()).check(*result.best).valid());
  // Both are meshes of frequency 6: an edge spans 10 degrees, so a vertex may stand (1 - cos 5 degrees) = 0.4
  // % above the other's facets. Some 2 % more are the search's, in 85 rounds of 20.
  EXPECT_GT(result.best->pose.scale, 0.976);
  EXPECT_LT(result.best->pose.scale, 1.004);
  EXPECT_GT(result.aborted, result.state.evaluations() / 3);
}

TEST(Optimise, KeepsWhatIsFixed) {
  OptimiseSpec spec = quick("position");
  spec.freedom.given.cut = Cut::through(Vec3(0, 0, 0.1), Vec3::UnitX());
  const OptimiseResult result = optimise(egg(), test_device(), spec);
  ASSERT_TRUE(result.best);
  EXPECT_EQ(result.best->cut.normal, Vec3::UnitX());
  EXPECT_EQ(result.best->cut.offset, 0);
  EXPECT_EQ(result.best->pose.rotation, Eigen::Matrix3d::Identity());
}

TEST(Optimise, EveryVariantFindsANesting) {
  for (const std::string_view variant : variants()) {
    OptimiseSpec spec = quick("position,centroid-plane");
    spec.variant = variant;
    spec.search.swarm.iterations = 12;
    spec.search.climbs = 0;
    if (variant == "basic") {
      spec.test = "envelope";
      spec.resolution = 64;
    }
    const OptimiseResult result = optimise(egg(), test_device(), spec);
    ASSERT_TRUE(result.best) << variant;
    EXPECT_GT(result.best->pose.scale, 0.4) << variant;
    EXPECT_GT(result.state.evaluations(), 200u) << variant;
  }
}

TEST(Optimise, StopsWhenToldKeepsItsBestAndGoesOnFromThere) {
  const OptimiseSpec spec = quick("all");
  const OptimiseResult whole = optimise(egg(), test_device(), spec);
  const OptimiseResult part =
      optimise(egg(), test_device(), spec, [](const SearchState& s) { return s.swarm.iteration < 9; });
  EXPECT_TRUE(part.ended_early);
  ASSERT_TRUE(part.best);
  const OptimiseResult rest = optimise(egg(), test_device(), spec, {}, &part.state);
  EXPECT_EQ(rest.state.scale, whole.state.scale);
  EXPECT_EQ(rest.state.evaluations(), whole.state.evaluations());
}

// A centroid of the golden lattice's or a random one is inside A; anywhere in its box is outside an ellipsoid
// with probability 1 - pi/6, 48 %: of 200 none is with probability 1e-64.
TEST(Optimise, CentroidsStartDeepInsideUnlessAnywhereIsAsked) {
  const SurfaceRays rays(egg().outer());
  const auto outside = [&](Placing placing) {
    OptimiseSpec spec = quick("position");
    spec.search.swarm.placing = placing;
    spec.search.swarm.particles = 200;
    const OptimiseResult started =
        optimise(egg(), test_device(), spec, [](const SearchState&) { return false; });
    const std::vector<double>& x = started.state.swarm.x;
    int out = 0;
    for (std::size_t i = 0; i < x.size(); i += 3) {
      const auto hit = rays.first({x[i], x[i + 1], x[i + 2]}, Vec3::UnitX(), 0, 10);
      out += hit && hit->out ? 0 : 1;
    }
    return out;
  };
  EXPECT_EQ(outside(Placing::lattice), 0);
  EXPECT_EQ(outside(Placing::random), 0);
  EXPECT_GT(outside(Placing::anywhere), 20);
}

TEST(Optimise, StartsDeepInsideAndRefusesUnknownNamesAndForeignCheckpoints) {
  const std::vector<Vec3> deep = deep_points(egg(), 500);
  ASSERT_GT(deep.size(), 100u);
  // Half-axes in nesting units, and the lattice's step: the deepest of its points is next to the centre.
  EXPECT_LT(deep.front().norm(), 2 * std::cbrt(egg().outer_box().extent().prod() / 500));
  OptimiseSpec spec = quick("all");
  const OptimiseResult result =
      optimise(egg(), test_device(), spec, [](const SearchState& s) { return s.swarm.iteration < 1; });
  spec.search.swarm.particles = 21;
  expect_refusal([&] { (void)optimise(egg(), test_device(), spec, {}, &result.state); }, "a checkpoint of",
                 {"21 particles"});
  spec.search.swarm.particles = quick("all").search.swarm.particles;
  const auto expect_damage = [&](const std::function<void(SearchState&)>& damage) {
    SearchState state = result.state;
    damage(state);
    EXPECT_THROW((void)optimise(egg(), test_device(), spec, {}, &state), UnfitState);
  };
  expect_damage([](SearchState& s) { s.swarm.v.pop_back(); });
  expect_damage([](SearchState& s) { s.swarm.x.front() = std::numeric_limits<double>::quiet_NaN(); });
  expect_damage([](SearchState& s) { s.swarm.iteration = -1; });
  expect_damage([](SearchState& s) { s.swarm.placed.front() = std::numeric_limits<int>::max(); });
  expect_damage([](SearchState& s) { s.scale = std::numeric_limits<double>::infinity(); });
  spec.variant = "hybird";
  expect_refusal([&] { (void)optimise(egg(), test_device(), spec); }, "variant 'hybird' is unknown",
                 {"did you mean 'hybrid'"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::nest
