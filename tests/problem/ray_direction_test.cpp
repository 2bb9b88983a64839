#include "problem/ray_direction.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "domain/test_bodies.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Of a box of 2 x 1 x 0.5 about (0, 0, 0.25) in the body frame, whose x is the model's y, y its z, z its x.
Body lying_box() {
  Body body = body_of(box_mesh({-1, -0.5, 0}, {1, 0.5, 0.5}));
  body.frame.rotation << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  body.axis = Vec3::UnitX();
  return body;
}

std::optional<Vec3> towards(const Vec3& in_body, const std::string& line = "") {
  const Body body = lying_box();
  const Vec3 p = body.frame.to_model(Vec3(0, 0, 0.25) + in_body);
  SettingTexts settings = {{"point", fmt::format("{},{},{}", p[0], p[1], p[2])}};
  if (!line.empty()) settings["line"] = line;
  return rays_of_balance(find_problem("balance").read(settings), body);
}

TEST(RayDirection, IsTheModelsAxisMostSquarelyAcrossTheCut) {
  EXPECT_EQ(towards({0.01, 0, 0}), Vec3(0, 1, 0));
  EXPECT_EQ(towards({0, 0.01, 0}), Vec3(0, 0, 1));
  // Sigma is diag(4, 1, 1/4) / 12: the longer a side, the less it takes to move the centre of mass along it.
  EXPECT_EQ(towards({0.01, 0.003, 0}), Vec3(0, 0, 1)) << "(0.0025, 0.003)";
  EXPECT_EQ(towards({0.01, 0.002, 0}), Vec3(0, 1, 0)) << "(0.0025, 0.002)";
}

TEST(RayDirection, StaysWhereTheBodysOwnAxisIsAcrossTheCut) {
  EXPECT_FALSE(towards({0, 0, 0.01}));
  EXPECT_FALSE(towards({0.01, 0.002, 0.0007})) << "(0.0025, 0.002, 0.0028)";
  EXPECT_FALSE(towards({0, 0, 0})) << "nothing to move";
}

TEST(RayDirection, OnALineGoesByWhatIsAcrossIt) {
  EXPECT_EQ(towards({0.01, 0, 0.5}, "1,0,0"), Vec3(0, 1, 0)) << "along the body's z nothing counts";
  EXPECT_FALSE(towards({0, 0, 0.01}, "0,1,0"));
}

TEST(RayDirection, IsOpenInNoOtherProblem) {
  // Those that ask for a centre of mass at a point or on a line.
  const std::set<std::string> open = {"balance", "hang", "die"};
  for (const ProblemEntry& entry : problems())
    EXPECT_EQ(static_cast<bool>(entry.rays), open.contains(entry.name)) << entry.name;
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
