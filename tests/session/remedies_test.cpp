#include "session/remedies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "domain/test_bodies.hpp"
#include "problem/balance.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

RunConfig config_of(double wall) {
  RunConfig config;
  config.formulation = "quadric";
  config.grid.resolution = 40;
  config.wall = {wall, Wall::millimetres};
  return config;
}

/// The number that follows `words` in the text.
double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? NAN : std::stod(text.substr(at + words.size()));
}

// A box [-1/2, 1/2]^2 x [0, 1], body units. With voids below a plane z = t and the wall w all round, the
// centre of mass rises most when the void is the lower half or so; heights above it cannot be had.
TEST(WhatWouldHelp, IsTheWallAtWhichABoxJustBalances) {
  const Body body = body_of(box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  // The highest centre of mass by hand: void of w <= z <= t over (1 - 2w)^2, at the best t.
  const auto highest = [](double w) {
    double best = 0;
    for (int i = 0; i <= 10000; ++i) {
      const double t = w + (1 - 2 * w) * i / 10000, v = (1 - 2 * w) * (1 - 2 * w) * (t - w);
      best = std::max(best, (0.5 - v * (t + w) / 2) / (1 - v));
    }
    return best;
  };
  const double wanted = highest(0.1);  // just possible with a wall of 0.1
  const Balance problem({0, 0, wanted}, Vec3(1, 0, 0));
  const std::string text = what_would_help(config_of(0.2), body, problem, test_device(), {});
  // Bisection to a percent; columns of 1/40 catch the side walls to half a cell in sixteen.
  EXPECT_NEAR(number_after(text, "a wall of "), 0.1, 0.013) << text;
  EXPECT_EQ(text.find("lighter"), std::string::npos) << text;
}

TEST(WhatWouldHelp, IsTheDensityAtWhichAHeavyInteriorLiftsTheCentre) {
  const Body body = body_of(box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  const double w = 0.1;
  // The same with an upper part of extra density k in place of a void.
  const auto highest = [&](double k) {
    double best = 0;
    for (int i = 0; i <= 10000; ++i) {
      const double t = w + (1 - 2 * w) * i / 10000, v = k * (1 - 2 * w) * (1 - 2 * w) * (1 - w - t);
      best = std::max(best, (0.5 + v * (t + 1 - w) / 2) / (1 + v));
    }
    return best;
  };
  const Balance problem({0, 0, highest(6.0)}, Vec3(1, 0, 0));
  const std::string text = what_would_help(config_of(w), body, problem, test_device(), {});
  EXPECT_NEAR(number_after(text, "parts of the interior of "), 7, 0.25) << text;
}

TEST(WhatWouldHelp, IsTheDensityAtWhichAHeavyInteriorWithVoidsLiftsTheCentre) {
  const Body body = body_of(box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  const double w = 0.1, shell = 1 - std::pow(1 - 2 * w, 3);
  // An upper part of density d, nothing below it.
  const auto highest = [&](double d) {
    double best = 0;
    for (int i = 0; i <= 10000; ++i) {
      const double t = w + (1 - 2 * w) * i / 10000, v = d * (1 - 2 * w) * (1 - 2 * w) * (1 - w - t);
      best = std::max(best, (0.5 * shell + v * (t + 1 - w) / 2) / (shell + v));
    }
    return best;
  };
  const Balance problem({0, 0, highest(3.0)}, Vec3(1, 0, 0));
  const std::string text = what_would_help(config_of(w), body, problem, test_device(), {});
  EXPECT_NEAR(number_after(text, "an interior of "), 3, 0.12) << text;

  // With heavy voids the roles are swapped: they are what has to be heavier.
  Body swapped = body;
  swapped.interior_density = 0.5;
  swapped.void_density = 2;
  const std::string other = what_would_help(config_of(w), swapped, problem, test_device(), {});
  EXPECT_GT(number_after(other, "voids of "), 3) << other;
  EXPECT_NE(other.find("--void-density"), std::string::npos) << other;
}

TEST(WhatWouldHelp, SaysSoWhenNothingDoes) {
  const Body body = body_of(box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  const std::string text =
      what_would_help(config_of(0.1), body, Balance({0, 0, 1.2}, std::nullopt), test_device(), {});
  EXPECT_EQ(text.find("nothing that was tried"), 0u) << text;
}

TEST(WhatWouldHelp, KnowsLighterVoids) {
  Body body = body_of(box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  body.void_density = 0.8;
  const double w = 0.1, k = 0.5;  // just possible with voids of half the density
  double best = 0;
  for (int i = 0; i <= 10000; ++i) {
    const double t = w + (1 - 2 * w) * i / 10000, v = k * (1 - 2 * w) * (1 - 2 * w) * (t - w);
    best = std::max(best, (0.5 - v * (t + w) / 2) / (1 - v));
  }
  const std::string text =
      what_would_help(config_of(w), body, Balance({0, 0, best}, Vec3(1, 0, 0)), test_device(), {});
  EXPECT_NEAR(number_after(text, "voids of "), 0.5, 0.03) << text;
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
