#include "nest/search/swarm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nest/known_objectives.hpp"
#include "refusal.hpp"

namespace kreisel::core::nest {
namespace THIS_FILE {

Target mixed_target(double wall = -1e9) {
  const double half = std::sqrt(0.5);
  return {{{Block::number, -1, 1}, {Block::number, 0, 2}, {Block::direction}, {Block::rotation}},
          {0.3, 1.2, 0.6, 0, 0.8, half, 0, half, 0},
          wall};
}

/// What suits analytic functions: swarms that contract.
SwarmOptions contracting(int iterations) {
  SwarmOptions options;
  options.particles = 40;
  options.iterations = iterations;
  options.momentum = Momentum::constriction;
  return options;
}

SwarmState run(Objective& objective, const SwarmOptions& options) {
  const Swarm swarm(objective, options);
  SwarmState state = swarm.start();
  while (state.iteration < options.iterations) swarm.step(state);
  return state;
}

class SwarmOf : public testing::TestWithParam<Topology> {};

// A contracting swarm's spread falls by a factor of about 0.9 an iteration: 1e-10 of the value's range, of a
// few units, after 300.
TEST_P(SwarmOf, EndsAtTheMaximumOnNumbersDirectionsAndRotations) {
  Target target = mixed_target();
  SwarmOptions options = contracting(300);
  options.topology = GetParam();
  const SwarmState state = run(target, options);
  EXPECT_GT(state.best_value, -1e-10);
  EXPECT_EQ(state.best_value, target.value(state.best));
  EXPECT_EQ(state.evaluations, 301u * 40);
}

TEST_P(SwarmOf, FindsTheMaximumBehindAnInfeasibleHalf) {
  Target target = mixed_target(0.25);
  SwarmOptions options = contracting(300);
  options.topology = GetParam();
  const SwarmState state = run(target, options);
  EXPECT_GT(state.best_value, -1e-9);
}

INSTANTIATE_TEST_SUITE_P(Topologies, SwarmOf,
                         testing::Values(Topology::global, Topology::ring, Topology::von_neumann,
                                         Topology::random),
                         [](const auto& tested) {
                           std::string name(to_string(tested.param));
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(Swarm, IsTheSameForASeedAndAnotherForAnother) {
  Target target = mixed_target();
  SwarmOptions options = contracting(20);
  const SwarmState one = run(target, options), again = run(target, options);
  EXPECT_EQ(one.x, again.x);
  EXPECT_EQ(one.best_value, again.best_value);
  options.seed = 2;
  EXPECT_NE(run(target, options).x, one.x);
}

TEST(Swarm, GoesOnFromACopyAsIfItHadNeverStopped) {
  Target target = mixed_target();
  SwarmOptions options = contracting(30);
  options.topology = Topology::random;
  options.patience = 5;
  options.swarms = 3;
  const SwarmState whole = run(target, options);
  const Swarm first(target, options);
  SwarmState state = first.start();
  while (state.iteration < 11) first.step(state);
  const SwarmState kept = state;
  SwarmState resumed = kept;
  const Swarm second(target, options);
  while (resumed.iteration < 30) second.step(resumed);
  EXPECT_EQ(resumed.x, whole.x);
  EXPECT_EQ(resumed.best, whole.best);
  EXPECT_EQ(resumed.evaluations, whole.evaluations);
}

TEST(Swarm, StartsAnewWhenItHasNotRisenAndKeepsTheBestEverSeen) {
  Target target = mixed_target();
  SwarmOptions options = contracting(120);
  options.patience = 10;
  options.rise = 0.5;  // so that convergence soon counts as standing still
  const Swarm swarm(target, options);
  SwarmState state = swarm.start();
  double best = state.best_value;
  bool anew = false;
  while (state.iteration < options.iterations) {
    const SwarmStep step = swarm.step(state);
    EXPECT_GE(step.best, best);
    best = step.best;
    // Its particles know nothing of what was before.
    anew = anew || *std::ranges::max_element(state.own_value) < state.best_value;
  }
  EXPECT_TRUE(anew);
}

TEST(Swarm, ParticlesOfOtherSwarmsAreNotFollowed) {
  // Two particles, each a swarm: with nobody to follow but itself and no momentum, a particle stays.
  Target target = mixed_target();
  SwarmOptions options;
  options.particles = options.swarms = 2;
  options.iterations = 5;
  options.inertia = 0;
  options.first_speed = 0;
  const Swarm swarm(target, options);
  SwarmState state = swarm.start();
  const std::vector<double> before = state.x;
  swarm.step(state);
  // Projection normalises again: round-off.
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_NEAR(state.x[k], before[k], 1e-15);
}

TEST(Swarm, ParticlesStartFromTheBestOfTheirCandidates) {
  Target target = mixed_target();
  SwarmOptions options;
  options.particles = 10;
  options.candidates = 6;
  options.inertia = options.own = options.social = 0;  // so that a particle stays where it starts
  const Swarm swarm(target, options);
  SwarmState state = swarm.start();
  std::vector<double> best = state.own_value;
  for (int round = 1; round < 6; ++round) {
    const std::vector<double> before = state.x;
    swarm.step(state);
    EXPECT_NE(state.x, before);
    for (std::size_t i = 0; i < best.size(); ++i) {
      const double here = target.value(std::span(state.x).subspan(i * 9, 9));
      best[i] = std::max(best[i], here);
    }
  }
  EXPECT_EQ(state.own_value, best);
  swarm.step(state);
  for (std::size_t i = 0; i < best.size(); ++i)
    EXPECT_NEAR(target.value(std::span(state.x).subspan(i * 9, 9)), best[i], 1e-13) << "projected once more";
}

TEST(Swarm, MomentumFallsInEqualStepsToTheLast) {
  // One particle, alone: its velocity only shrinks, by the inertia of the iteration.
  Target target({{Block::number, -1e6, 1e6}}, {0});
  SwarmOptions options;
  options.particles = 1;
  options.iterations = 5;
  options.momentum = Momentum::decreasing;
  options.inertia = 0.9;
  options.last_inertia = 0.5;
  options.own = options.social = 0;
  const Swarm swarm(target, options);
  SwarmState state = swarm.start();
  for (const double keep : {0.9, 0.8, 0.7, 0.6, 0.5}) {
    const double before = state.v[0];
    swarm.step(state);
    EXPECT_NEAR(state.v[0] / before, keep, 1e-12);
  }
}

TEST(Swarm, OfOneParticleAndNoIterationsIsOneEvaluation) {
  Target target = mixed_target();
  SwarmOptions options;
  options.particles = 1;
  options.iterations = 0;
  const SwarmState state = run(target, options);
  EXPECT_EQ(target.asked(), 1u);
  EXPECT_EQ(state.best, state.x);
}

TEST(Swarm, RefusesUnfitOptionsByName) {
  Target target = mixed_target();
  const auto expect_refused = [&](auto set, const std::string& start, const std::string& expected) {
    SwarmOptions options;
    set(options);
    expect_refusal([&] { Swarm(target, options); }, "swarm: " + start, {expected});
  };
  expect_refused([](auto& o) { o.inertia = 1.4; }, "inertia = 1.4", "a number in [0, 1]");
  expect_refused([](auto& o) { o.particles = 0; }, "particles = 0", "at least one");
  expect_refused([](auto& o) { o.swarms = 300; }, "swarms = 300", "as many as particles");
  expect_refused([](auto& o) { o.own = NAN; }, "own = nan", "a number >= 0");
  expect_refusal([] { (void)parse_topology("rnig"); }, "topology 'rnig' is unknown (did you mean 'ring'?)",
                 {"global, ring, von-neumann, random"});
}

TEST(Swarm, TakesInAPositionInPlaceOfItsWorstWhereItIsBetter) {
  Target target = mixed_target();
  const Swarm swarm(target, contracting(10));
  SwarmState state = swarm.start();
  const SwarmState before = state;
  const auto size = static_cast<std::ptrdiff_t>(target.space().size());
  const auto worst = std::ranges::min_element(before.own_value) - before.own_value.begin();
  const std::vector<double> of_worst(before.own.begin() + worst * size,
                                     before.own.begin() + (worst + 1) * size);
  swarm.take_in(state, of_worst);
  EXPECT_EQ(state.own, before.own) << "no better than the worst";
  EXPECT_EQ(state.evaluations, before.evaluations + 1);

  std::vector<double> best = before.best;
  best[0] = 0.3;  // as the target's: nearer
  swarm.take_in(state, best);
  EXPECT_EQ(state.best, best);
  EXPECT_EQ(state.best_value, target.value(best));
  EXPECT_EQ(state.top.front(), state.best_value);
  EXPECT_EQ(state.own_value[static_cast<std::size_t>(worst)], state.best_value);
  for (std::ptrdiff_t i = 0; i < 40; ++i)
    EXPECT_EQ(std::equal(state.own.begin() + i * size, state.own.begin() + (i + 1) * size,
                         before.own.begin() + i * size),
              i != worst);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::nest
