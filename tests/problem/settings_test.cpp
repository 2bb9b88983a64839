// settings_test.cpp - what the registry says of the settings of each problem.
#include <gtest/gtest.h>

#include "domain/test_bodies.hpp"
#include "problem/problem.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace {

TEST(ProblemSettings, OfTheRegistryAreThoseThatEachProblemTakes) {
  const std::map<std::string_view, ProblemSettings> valid = {
      {"spin", {{"lambda", "0"}, {"gamma_i", "1"}}},
      {"top", {{"lower", "height"}, {"gamma_c", "0"}, {"gamma_i", "1"}, {"form", "angle"}}},
      {"yoyo", {{"gamma_i", "2"}, {"form", "trace"}}},
      {"stand", {{"target", "inside"}, {"margin", "0.1"}, {"base", "2%"}}},
      {"float", {{"draft", "60%"}, {"fluid_density", "1.2"}}},
      {"balance", {{"point", "0,0,0"}, {"line", "0,1,0"}}},
      {"hang", {{"point", "0,0,19"}, {"line", "0,0,1"}}},
      {"die", {}}};
  const Body body = body_of(box_mesh({-0.5, -0.25, -0.1}, {0.5, 0.25, 1.9}), 10);
  for (const ProblemEntry& entry : problems()) {
    ASSERT_TRUE(valid.contains(entry.name)) << entry.name;
    const ProblemSettings& settings = valid.at(entry.name);
    EXPECT_NE(entry.make(settings, body), nullptr) << entry.name;
    EXPECT_EQ(entry.settings.size(), settings.size()) << entry.name;
    for (const std::string_view name : entry.settings)
      EXPECT_TRUE(settings.contains(std::string(name))) << entry.name << ' ' << name;
    expect_refusal([&] { (void)entry.make({{"nosuch", "1"}}, body); }, "problem.nosuch = 1", {});
  }
}

}  // namespace
}  // namespace kreisel::core
