#include "problem/stand.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "domain/test_bodies.hpp"
#include "problem/differences.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double round_off = 64 * 0x1p-53;  // numbers of order one, a handful of roundings each

double degrees(double tangent) { return std::atan(tangent) * 180 / std::numbers::pi; }

/// On [-0.5,0.5] x [-0.25,0.25], its ground at -0.25, 2 high.
Base base() { return {hull_of({{-0.5, -0.25}, {0.5, -0.25}, {0.5, 0.25}, {-0.5, 0.25}}), -0.25, 2}; }

Body box_body(double length = 1) { return body_of(box_mesh({-0.5, -0.25, 0}, {0.5, 0.25, 2}), length); }

TEST(Stand, DerivativesMatchCentralDifferences) {
  Random random(81);
  for (int trial = 0; trial < 20; ++trial) {
    const Moments s = random_solid(random);
    expect_derivatives(Stand(base(), std::nullopt), s, s[S1]);
    expect_derivatives(Stand(base(), 0.1), s, s[S1]);
  }
}

TEST(MaxTilt, DerivativesMatchCentralDifferences) {
  Random random(82);
  for (int trial = 0; trial < 20; ++trial) {
    // Nearer to one edge than to the others by more than a step, or there is no derivative.
    const Moments s = random_solid(random) + 0.1 * Moments::Unit(trial % 2 ? SX : SY);
    expect_derivatives(MaxTilt(base(), 0.3), s, std::min(s[S1], s[SZ] + 0.25 * s[S1]));
  }
}

TEST(Stand, ValueIsTheHeightOfTheCentreOfMass) {
  EXPECT_NEAR(Stand(base(), std::nullopt).value(box_moments({0, 0, 0.7}, {1, 2, 0.5})), 0.7, round_off);
}

TEST(MaxTilt, ValueIsMinusTheTangentOfTheTopplingAngle) {
  // 0.65 above the ground: 0.25 to the long edges, then 0.2 to the right one.
  EXPECT_NEAR(MaxTilt(base(), 0).value(box_moments({0, 0, 0.4}, {1, 2, 0.5})), -0.25 / 0.65, round_off);
  EXPECT_NEAR(MaxTilt(base(), 0).value(box_moments({0.3, 0, 0.4}, {1, 2, 0.5})), -0.2 / 0.65, round_off);
  EXPECT_NEAR(MaxTilt(base(), 0).value(box_moments({0.8, 0, 0.4}, {1, 2, 0.5})), 0.3 / 0.65, round_off);
}

TEST(Stand, OverTheCentreIsTwoEquations) {
  const Base shifted{hull_of({{0, 0}, {2, 0}, {2, 1}, {0, 1}}), 0, 1};
  const Stand stand(shifted, std::nullopt);
  EXPECT_EQ(stand.constraints().matrix.rows(), 2);
  EXPECT_EQ(stand.constraints().names.size(), 2u);
  EXPECT_NEAR(violation(stand, box_moments({1, 0.5, 0.3}, {1, 1, 1})), 0, round_off);
  // First moments per unit of mass, so mass times the distance.
  EXPECT_NEAR(violation(stand, box_moments({1.2, 0.5, 0.3}, {1, 1, 2})), 0.4, round_off);
  EXPECT_NEAR(violation(stand, box_moments({1, 0.4, 0.3}, {1, 1, 2})), 0.2, round_off);
}

TEST(Stand, InsideKeepsItsMarginFromEveryEdge) {
  const Stand stand(base(), 0.1);
  EXPECT_EQ(stand.constraints().matrix.rows(), 4);
  EXPECT_EQ(stand.constraints().names.size(), 4u);
  EXPECT_NEAR(violation(stand, box_moments({0.39, -0.14, 5}, {1, 1, 2})), 0, round_off);
  EXPECT_NEAR(violation(stand, box_moments({0.45, 0, 5}, {1, 1, 2})), 2 * 0.05, round_off);
  EXPECT_NEAR(violation(stand, box_moments({0, -0.35, 5}, {1, 1, 2})), 2 * 0.2, round_off);
}

TEST(MaxTilt, RowsAreTheTiltOverEveryEdge) {
  const double tau = 0.3;
  const MaxTilt tilt(base(), tau);
  // At a height of 0.5 the tilt takes 0.15, so the centre of mass may be 0.1 off the middle.
  EXPECT_NEAR(violation(tilt, box_moments({0, 0.1, 0.25}, {1, 1, 2})), 0, round_off);
  EXPECT_NEAR(violation(tilt, box_moments({0, 0.2, 0.25}, {1, 1, 2})), 2 * 0.1, round_off);
  EXPECT_NEAR(violation(tilt, box_moments({0.35, 0.2, 0.25}, {1, 1, 2})), 2 * 0.1, round_off);
  EXPECT_NEAR(violation(tilt, box_moments({0.5, 0.2, 0.25}, {1, 1, 2})), 2 * 0.15, round_off);
}

TEST(MaxTilt, GoesOnFromTheTiltThatWasReachedAndStopsWhenNothingIsGained) {
  const MaxTilt tilt(base(), 0.3);
  const Moments s = box_moments({0, 0, 0.25}, {1, 1, 2});  // tangent 0.25 / 0.5
  const auto next = tilt.next(s);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->goal(), Goal::margin);
  EXPECT_NEAR(violation(*next, s), 0, round_off) << "its rows are those of the tilt of s";
  EXPECT_NEAR(violation(*next, box_moments({0, 0, 0.26}, {1, 1, 2})), 2 * 0.01 * 0.5, round_off);
  EXPECT_FALSE(next->next(s)) << "nothing gained";
  EXPECT_FALSE(MaxTilt(base(), 0.5 - 1e-7).next(s)) << "less than a millionth";
  EXPECT_TRUE(MaxTilt(base(), 0.5 - 1e-5).next(s));
  EXPECT_FALSE(MaxTilt(base(), 0.6).next(s)) << "never backwards";
}

TEST(StandVerdict, ABoxStandsAndTopplesWhereAPocketCalculatorSays) {
  const Moments s = box_moments({0.1, 0, 0.4}, {1, 0.5, 1.3});
  for (const Verdict& v : {Stand(base(), std::nullopt).verify(s, 50), MaxTilt(base(), 0).verify(s, 50)}) {
    EXPECT_TRUE(v.ok);
    EXPECT_NEAR(v.values.at("inside_mm"), 12.5, 50 * round_off);
    EXPECT_NEAR(v.values.at("off_centroid_mm"), 5, 50 * round_off);
    EXPECT_NEAR(v.values.at("tilt_degrees"), degrees(0.25 / 0.65), 100 * round_off);
    EXPECT_NEAR(v.values.at("tilt_degrees"), 21.04, 0.005) << "the figure itself";
    EXPECT_NEAR(v.values.at("centre_of_mass_z_mm"), 32.5, 50 * round_off);
    EXPECT_NEAR(v.values.at("height_share"), 0.325, round_off);
    EXPECT_NEAR(v.values.at("base_area_mm2"), 1250, 2500 * round_off);
    expect_text(v,
                "stands: centre of mass 12.500 mm inside the edge of the base, at 32.5 % of the height; "
                "topples at a tilt of 21.04 degrees");
  }
  EXPECT_NEAR(Stand(base(), std::nullopt).verify(s, 50).values.at("objective"), 0.4, round_off);
  EXPECT_NEAR(MaxTilt(base(), 0).verify(s, 50).values.at("objective"), -0.25 / 0.65, round_off);
}

TEST(StandVerdict, ACentreOfMassBesideTheBaseDoesNotStand) {
  const Verdict v = Stand(base(), 0.1).verify(box_moments({0, 0.35, 0.75}, {1, 1, 1}), 50);
  EXPECT_FALSE(v.ok);
  expect_text(v, "does not stand: centre of mass 5.000 mm outside the base, at 50.0 % of the height");
  EXPECT_NEAR(v.values.at("inside_mm"), -5, 50 * round_off);
  EXPECT_NEAR(v.values.at("tilt_degrees"), degrees(-0.1), 100 * round_off);
  EXPECT_TRUE(Stand(base(), 0.1).verify(box_moments({0, 0.24, 0.75}, {1, 1, 1}), 50).ok)
      << "judged by the base itself, not by the margin";
}

TEST(MakeStand, TakesItsTargets) {
  const Body body = box_body();
  for (const char* target : {"centre", "inside", "max-tilt"}) {
    const auto problem = make_problem("stand", {{"target", target}}, body);
    EXPECT_EQ(problem->name(), "stand");
    EXPECT_EQ(problem->traits().filling, Filling::from_below);
    EXPECT_EQ(problem->goal(), std::string(target) == "max-tilt" ? Goal::margin : Goal::value);
    EXPECT_EQ(problem->constraints().matrix.rows(), std::string(target) == "centre" ? 2 : 4);
  }
  EXPECT_EQ(make_problem("stand", {}, body)->constraints().matrix.rows(), 2) << "centre by default";
}

TEST(MakeStand, InsideTakesItsMarginInMillimetres) {
  const Body body = box_body(50);
  const Moments at = box_moments({0, 0.2, 1}, {1, 1, 1});  // 0.05 L = 2.5 mm from the edge
  const auto miss = [&](const char* margin) {
    return violation(*make_problem("stand", {{"target", "inside"}, {"margin", margin}}, body), at);
  };
  EXPECT_NEAR(miss("2.4"), 0, round_off);
  EXPECT_NEAR(miss("5"), 0.05, round_off);
  EXPECT_EQ(miss("0"), 0);
  const auto by_default = make_problem("stand", {{"target", "inside"}}, body);
  EXPECT_NEAR(violation(*by_default, box_moments({0, 0.25, 1}, {1, 1, 1})), 0.01, round_off);
  // A base 0.02 wide has its centroid 0.01 from the edge: half of that.
  const Body narrow = body_of(box_mesh({-1, -0.01, 0}, {1, 0.01, 1}));
  EXPECT_NEAR(
      violation(*make_problem("stand", {{"target", "inside"}}, narrow), box_moments({0, 0.01, 1}, {1, 1, 1})),
      0.005, round_off);
}

TEST(MakeStand, MaxTiltStartsAtTheSolidsOwnTiltOrAtNone) {
  const Body box = box_body();  // centre of mass 1 above the base, 0.25 from its long edges
  const auto problem = make_problem("stand", {{"target", "max-tilt"}}, box);
  EXPECT_NEAR(violation(*problem, box.solid), 0, round_off);
  EXPECT_NEAR(violation(*problem, box_moments({0, 0, 1.1}, {1, 1, 1})), 0.1 * 0.25, round_off);
  Body leaning = box_body();
  leaning.solid = transformed(leaning.solid, Eigen::Matrix3d::Identity(), {0, 1, 0});
  const auto upright = make_problem("stand", {{"target", "max-tilt"}}, leaning);
  EXPECT_NEAR(violation(*upright, box_moments({0, 0.25, 9}, {1, 1, 1})), 0, round_off) << "height is free";
  EXPECT_NEAR(violation(*upright, box_moments({0, 0.35, 9}, {1, 1, 1})), 0.1, round_off);
}

TEST(MakeStand, BaseWidensWhatTouchesTheGround) {
  // A box with a bevelled edge: its lowest face ends at y = 0, the bevel's rim at y = 0.25 is 0.1 of 2
  // higher.
  TriangleMesh mesh = box_mesh({-0.5, -0.25, 0}, {0.5, 0.25, 2});
  for (Vec3& v : mesh.vertices)
    if (v[1] > 0 && v[2] == 0) v[2] = 0.2;
  mesh.vertices.emplace_back(-0.5, 0, 0);
  mesh.vertices.emplace_back(0.5, 0, 0);  // touch nothing; only vertices count
  const auto area = [&](const SettingTexts& settings) {
    const Body body = body_of(mesh);
    return make_problem("stand", settings, body)->verify(body.solid, 1).values.at("base_area_mm2");
  };
  EXPECT_NEAR(area({}), 0.25, round_off);
  EXPECT_NEAR(area({{"base", "9.9%"}}), 0.25, round_off);
  EXPECT_NEAR(area({{"base", "10.1%"}}), 0.5, round_off);
  EXPECT_NEAR(area({{"base", "0%"}}), 0.25, round_off);
}

TEST(MakeStand, RefusesUnfitSettingsAndBodies) {
  const Body body = box_body(50);
  expect_refused("stand", {{"target", "foo"}}, body, "problem.target = foo; expected");
  expect_refused("stand", {{"target", ""}}, body, "centre, inside or max-tilt");
  expect_refused("stand", {{"target", "inside"}, {"margin", "-1"}}, body, "problem.margin = -1; expected");
  expect_refused("stand", {{"target", "inside"}, {"margin", "1mm"}}, body, "problem.margin = 1mm");
  expect_refused("stand", {{"margin", "1"}}, body, "problem.margin = 1 for target centre");
  expect_refused("stand", {{"target", "max-tilt"}, {"margin", "1"}}, body, "for target max-tilt");
  expect_refused("stand", {{"target", "inside"}, {"margin", "12.5"}}, body, "problem.margin = 12.5");
  for (const char* base : {"0.1", "-1%", "100%", "x%", "nan%"})
    expect_refused("stand", {{"base", base}}, body, std::string("problem.base = ") + base + "; expected");
  expect_refused("stand", {{"lambda", "1"}}, body, "problem.lambda = 1; stand has no setting of that name");
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Vec3(1, 2, 0).normalized()).toRotationMatrix();
  const Body on_a_corner = body_of(moved(body.local, turn, Vec3::Zero()));
  expect_refused("stand", {{"base", "0.1%"}}, on_a_corner, "no base to stand on");
  const auto baseless = make_problem("stand", {}, on_a_corner);
  EXPECT_NE(baseless->impossible().find("test has no base to stand on as it lies"), std::string::npos);
  EXPECT_FALSE(baseless->verify(body.solid, 50).ok);
  EXPECT_TRUE(make_problem("stand", {}, body)->impossible().empty());
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
