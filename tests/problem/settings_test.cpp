// settings_test.cpp - what the registry says of the settings of each problem.
#include <gtest/gtest.h>

#include "domain/test_bodies.hpp"
#include "problem/problem.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(ProblemSettings, OfTheRegistryAreThoseThatEachProblemTakes) {
  const std::map<std::string_view, SettingTexts> valid = {
      {"spin", {{"lambda", "0"}, {"gamma_i", "1"}}},
      {"top", {{"lower", "height"}, {"gamma_c", "0"}, {"gamma_i", "1"}, {"form", "angle"}}},
      {"yoyo", {{"gamma_i", "2"}, {"form", "trace"}}},
      {"stand", {{"target", "inside"}, {"margin", "0.1"}, {"base", "2%"}}},
      {"float", {{"draft", "60%"}, {"fluid_density", "1.2"}, {"load", "2@0,0,1"}}},
      {"balance", {{"point", "0,0,0"}, {"line", "0,1,0"}}},
      {"hang", {{"point", "0,0,19"}, {"line", "0,0,1"}}},
      {"die", {}}};
  const Body body = body_of(box_mesh({-0.5, -0.25, -0.1}, {0.5, 0.25, 1.9}), 10);
  for (const ProblemEntry& entry : problems()) {
    ASSERT_TRUE(valid.contains(entry.name)) << entry.name;
    const SettingTexts& settings = valid.at(entry.name);
    EXPECT_NE(entry.make(entry.read(settings), body), nullptr) << entry.name;
    EXPECT_EQ(entry.settings.fields().size(), settings.size()) << entry.name;
    for (const Field<Settings>& field : entry.settings.fields())
      EXPECT_TRUE(settings.contains(std::string(field.name))) << entry.name << ' ' << field.name;
    expect_refusal([&] { (void)entry.read({{"nosuch", "1"}}); }, "problem.nosuch = 1", {entry.name});
  }
}

TEST(ProblemSettings, AreReadAsWhatTheirTextSays) {
  for (const ProblemEntry& entry : problems()) {
    // What is in force, written down and read again, is in force.
    const SettingTexts usual = entry.settings.in_force(entry.read({}));
    EXPECT_EQ(entry.settings.in_force(entry.read(usual)), usual) << entry.name;
    EXPECT_TRUE(entry.settings.changed(entry.read(usual)).empty()) << entry.name;
    for (const std::string& weight : entry.weights)
      EXPECT_TRUE(usual.contains(weight)) << entry.name << weight;
  }
}

TEST(ProblemSettings, OfADraftKeepTheirUnit) {
  const ProblemEntry& entry = find_problem("float");
  for (const char* draft : {"25%", "7%", "55%", "12.5mm", "40g", "solid", "auto"})
    EXPECT_EQ(entry.settings.in_force(entry.read({{"draft", draft}})).at("draft"), draft);
  for (const char* draft : {"", "0%", "101%", "-3", "0g", "deep", "60 %"})
    expect_refusal(
        [&] {
          (void)entry.read({{"draft", draft}});
        },
        fmt::format("problem.draft = '{}'; expected", draft), {"60%", "40g", "solid", "auto"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
