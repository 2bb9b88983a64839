#include "baselines/pagmo.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nest/known_objectives.hpp"
#include "refusal.hpp"

namespace kreisel::core::nest {
namespace THIS_FILE {

class BaselineOf : public testing::TestWithParam<Baseline> {};

// Swarm, evolutions converge linearly on a smooth maximum: 20 particles and 400 generations leave less than
// 1e-3 of a range in each of three numbers. Annealing ends at a temperature of 1e-4, at which values of some
// 1e-4 are usual, and of thousands of them the best is less than a tenth of that.
TEST_P(BaselineOf, EndsAtTheMaximumAndCountsWhatItAsks) {
  Target target({{Block::number, -1, 1}, {Block::direction}}, {0.3, 0.6, 0, 0.8}, -0.9);
  const BaselineResult result = search_with_pagmo(target, GetParam(), 20, 400, 1, {});
  EXPECT_GT(result.value, -1e-5);
  EXPECT_EQ(result.value, target.value(result.best));
  EXPECT_EQ(result.evaluations, target.asked());
}

TEST_P(BaselineOf, StopsWhenTold) {
  Target target({{Block::number, -1, 1}}, {0.3});
  int generations = 0;
  (void)search_with_pagmo(target, GetParam(), 10, 100, 1,
                          [&](double, std::uint64_t) { return ++generations < 3; });
  EXPECT_EQ(generations, 3);
}

INSTANTIATE_TEST_SUITE_P(Methods, BaselineOf,
                         testing::Values(Baseline::pso, Baseline::cmaes, Baseline::de, Baseline::ga,
                                         Baseline::sa));

TEST(Baselines, RefuseTooFewParticlesAndUnknownNames) {
  Target target({{Block::number, -1, 1}}, {0.3});
  expect_refusal([&] { (void)search_with_pagmo(target, Baseline::de, 3, 10, 1, {}); },
                 "pagmo-de with 3 particles", {"at least 5"});
  Target nothing({}, {});
  expect_refusal([&] { (void)search_with_pagmo(nothing, Baseline::pso, 9, 10, 1, {}); },
                 "pagmo-pso with nothing free", {});
  expect_refusal([] { (void)find_baseline("pagmo-cma"); },
                 "variant 'pagmo-cma' is unknown (did you mean 'pagmo-cmaes'?)", {});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::nest
