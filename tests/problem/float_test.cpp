#include "problem/float.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "domain/test_bodies.hpp"
#include "problem/differences.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double round_off = 64 * 0x1p-53;  // numbers of order one, a handful of roundings each
constexpr double length_mm = 50;

/// Volume one: 2 x 1 x 0.5, its base at z = 0, its middle at x = 0.3.
Body barge(double density = 1) {
  Body body = body_of(box_mesh({-0.7, -0.5, 0}, {1.3, 0.5, 0.5}), length_mm);
  body.density = density;
  return body;
}

/// The barge of density 2 in water, 0.3 deep: 0.6 displaced, which is 0.3 solid masses.
Draft draft() { return {hydrostatics(barge().local, 0.3), 0.3, 1, 2}; }

/// Mass and centre as given; a cube, whose second moments nobody looks at.
Moments load(double mass, const Vec3& centre) { return mass * box_moments(centre, Vec3::Ones()); }

TEST(Float, DerivativesMatchCentralDifferences) {
  Random random(85);
  for (int trial = 0; trial < 5; ++trial) expect_derivatives(Float(draft()), random_solid(random), 0.3);
}

TEST(Float, ValueIsTheHeightOfTheCentreOfMassOnceTheMassIsRight) {
  EXPECT_NEAR(Float(draft()).value(load(0.3, {0.3, 0, 0.2})), 0.2, round_off);
}

TEST(Float, IsMissedByMassAndByFirstMomentsAboutTheCentreOfBuoyancy) {
  const Float afloat(draft());
  EXPECT_EQ(afloat.constraints().matrix.rows(), 3);
  EXPECT_EQ(afloat.constraints().names.size(), 3u);
  EXPECT_NEAR(violation(afloat, load(0.3, {0.3, 0, 7})), 0, round_off);
  EXPECT_NEAR(violation(afloat, load(0.34, {0.3 * 0.3 / 0.34, 0, 7})), 0.04, round_off);
  EXPECT_NEAR(violation(afloat, load(0.3, {0.1, 0, 7})), 0.3 * 0.2, round_off);
  EXPECT_NEAR(violation(afloat, load(0.3, {0.3, 0.1, 7})), 0.3 * 0.1, round_off);
}

TEST(FloatVerdict, ABargeFloatsBelowItsMetacentre) {
  // BM = b^2 / (12 d) = 1 / 3.6, KB = 0.15: the metacentre is 0.4278 above the keel.
  const double km = 0.15 + 1 / 3.6;
  const Verdict v = Float(draft()).verify(load(0.3, {0.3005, 0, 0.2}), length_mm);
  EXPECT_TRUE(v.ok);
  EXPECT_NEAR(v.values.at("excess_mass"), 0, round_off);
  EXPECT_NEAR(v.values.at("offset_mm"), 0.025, length_mm * round_off);
  EXPECT_NEAR(v.values.at("metacentric_height_mm"), (km - 0.2) * length_mm, length_mm * round_off);
  EXPECT_NEAR(v.values.at("heel_degrees"), std::atan(0.0005 / (km - 0.2)) * 180 / std::numbers::pi,
              1000 * round_off);
  EXPECT_NEAR(v.values.at("centre_of_mass_z_mm"), 10, length_mm * round_off);
  EXPECT_NEAR(v.values.at("draft_mm"), 15, length_mm * round_off);
  EXPECT_NEAR(v.values.at("displaced_mm3"), 0.6 * 125000, 125000 * round_off);
  EXPECT_NEAR(v.values.at("centre_of_buoyancy_z_mm"), 7.5, length_mm * round_off);
  EXPECT_NEAR(v.values.at("waterplane_mm2"), 2 * 2500, 5000 * round_off);
  EXPECT_NEAR(v.values.at("objective"), 0.2, round_off);
  expect_text(v,
              "floats: mass +0.000 % of the displaced water's, centre of mass 0.025 mm from the vertical "
              "through the centre of buoyancy, metacentric height 11.389 mm; heels 0.13 degrees at rest");
}

void expect_reason(const Moments& s, const std::string& reasons) {
  const Verdict v = Float(draft()).verify(s, length_mm);
  EXPECT_FALSE(v.ok);
  expect_text(v, "does not float upright (" + reasons + "): ");
}

TEST(FloatVerdict, EveryReasonIsNamedAndHasItsLimit) {
  const Float afloat(draft());
  const auto ok = [&](const Moments& s) { return afloat.verify(s, length_mm).ok; };
  expect_reason(load(0.3 * 1.0011, {0.3, 0, 0.2}), "too heavy");
  expect_reason(load(0.3 * 0.9989, {0.3, 0, 0.2}), "too light");
  EXPECT_TRUE(ok(load(0.3 * 1.0009, {0.3, 0, 0.2})));
  EXPECT_TRUE(ok(load(0.3 * 0.9991, {0.3, 0, 0.2})));
  const std::string beside = "centre of mass beside the centre of buoyancy by more than 1e-3 L";
  expect_reason(load(0.3, {0.3008, 0.0008, 0.2}), beside);
  EXPECT_TRUE(ok(load(0.3, {0.3008, 0.0005, 0.2})));
  const std::string above = "centre of mass above the metacentre";
  expect_reason(load(0.3, {0.3, 0, 0.428}), above);
  EXPECT_TRUE(ok(load(0.3, {0.3, 0, 0.427})));
  EXPECT_TRUE(std::isnan(afloat.verify(load(0.3, {0.3, 0, 0.428}), 50).values.at("heel_degrees")));
  expect_reason(load(0.5, {0.4, 0, 0.5}), "too heavy; " + beside + "; " + above);
}

TEST(FloatScope, NamesTheDensitiesThatCanFloat) {
  // Shell of 0.25 solid masses. Water: 0.6 displaced. Material between 0.6 and 2.4; 4 at full draft.
  const std::string text = Float(draft()).scope({load(0.25, {0, 0, 0}), 1});
  EXPECT_EQ(text,
            "at this draft with a material of 0.6 to 2.4 g/cm^3, at some draft with up to 4 g/cm^3 (here 2)");
}

/// Waterline in body units and mass, from what the problem says of itself.
std::pair<double, double> depth_and_mass(const SettingTexts& settings, const Body& body) {
  const auto problem = make_problem("float", settings, body);
  const double mass = problem->constraints().lower[0];
  const Verdict v = problem->verify(load(mass, {0, 0, 0}), length_mm);
  EXPECT_NEAR(v.values.at("excess_mass"), 0, round_off);
  return {v.values.at("draft_mm") / length_mm, mass};
}

void expect_draft(const SettingTexts& settings, const Body& body, double depth, double mass) {
  const auto [got_depth, got_mass] = depth_and_mass(settings, body);
  EXPECT_NEAR(got_depth, depth, round_off);
  EXPECT_NEAR(got_mass, mass, round_off);
}

TEST(MakeFloat, TakesItsDraftAsShareDepthMassOrOfTheSolid) {
  expect_draft({}, barge(), 0.3, 0.6);
  expect_draft({{"draft", "60%"}}, barge(2), 0.3, 0.3);
  expect_draft({{"draft", "100%"}}, barge(2), 0.5, 0.5);
  expect_draft({{"draft", "10"}}, barge(2), 0.2, 0.2);
  expect_draft({{"draft", "10mm"}}, barge(2), 0.2, 0.2);
  // 50 mm cubed is 125 cm^3 of water when submerged: 25 g are a fifth.
  expect_draft({{"draft", "25g"}}, barge(2), 0.1, 0.1);
  expect_draft({{"draft", "solid"}}, barge(0.7), 0.35, 1);
  // In a fluid of density 2 everything lies half as deep, or carries twice as much.
  expect_draft({{"draft", "60%"}, {"fluid_density", "2"}}, barge(2), 0.3, 0.6);
  expect_draft({{"draft", "25g"}, {"fluid_density", "2"}}, barge(2), 0.05, 0.1);
  expect_draft({{"draft", "solid"}, {"fluid_density", "2"}}, barge(0.7), 0.175, 1);
}

TEST(MakeFloat, IsLinearAndFilledFromBelow) {
  const auto problem = make_problem("float", {}, barge());
  EXPECT_EQ(problem->name(), "float");
  EXPECT_EQ(problem->convexity(), Convexity::linear);
  EXPECT_EQ(problem->traits().filling, Filling::from_below);
  EXPECT_EQ(problem->goal(), Goal::value);
  const Eigen::VectorXd want = Eigen::Vector3d(0.6, 0.6 * 0.3, 0);
  EXPECT_NEAR((problem->constraints().lower - want).norm(), 0, round_off);
  EXPECT_EQ(problem->constraints().lower, problem->constraints().upper);
}

TEST(MakeFloat, MeasuresTheDraftFromTheLowestPoint) {
  const Body body = body_of(box_mesh({-1, -0.5, 2}, {1, 0.5, 2.5}), length_mm);
  expect_draft({{"draft", "60%"}}, body, 2.3, 0.6);
  expect_draft({{"draft", "10mm"}}, body, 2.2, 0.4);
  expect_draft({{"draft", "25g"}}, body, 2.1, 0.2);
}

TEST(MakeFloat, RefusesUnfitSettings) {
  for (const char* text : {"abc", "0%", "-5%", "101%", "0", "-1mm", "", "%", "nan", "-5g", "0g"})
    expect_refused("float", {{"draft", text}}, barge(),
                   std::string("problem.draft = ") + text + "; expected a share of the height");
  for (const char* text : {"26mm", "25.1mm"})
    expect_refused("float", {{"draft", text}}, barge(),
                   std::string("problem.draft = ") + text + ": test is 25 mm high");
  for (const char* text : {"0", "-1", "x", "nan"})
    expect_refused("float", {{"fluid_density", text}}, barge(),
                   std::string("problem.fluid_density = ") + text + "; expected a number > 0");
  expect_refused("float", {{"deep", "60%"}}, barge(),
                 "problem.deep = 60%; float has no setting of that name");
}

TEST(MakeFloat, RefusesAMassThatSinksAndSaysWhatTheBodyDisplaces) {
  expect_refused("float", {{"draft", "126g"}}, barge(),
                 "problem.draft = 126g: test sinks with 126 g; expected less than");
  expect_refused("float", {{"draft", "126g"}}, barge(), "125 g of fluid");
  expect_refused("float", {{"draft", "solid"}}, barge(3),
                 "sinks with 375 g; expected less than the 125 g of fluid");
  expect_refused("float", {{"draft", "solid"}}, barge(1),
                 "test hovers under water with 125 g; expected less than the 125 g of fluid");
}

TEST(Float, ALoadIsPartOfWhatFloats) {
  // 10 g at the keel's middle, 5 g on one side: of a barge of 125 g, of which the water carries 100 g.
  const Body body = barge();
  const Vec3 keel = body.frame.to_model({0.3, 0, 0}), side = body.frame.to_model({0.3, 0.4, 0.5});
  const std::string loads =
      fmt::format("10@{},{},{};5g@{},{},{}", keel[0], keel[1], keel[2], side[0], side[1], side[2]);
  const auto afloat = make_problem("float", {{"draft", "100g"}, {"load", loads}}, body);
  // The part is the rest: 85 g, with its centre of mass as far on the other side.
  const Moments part = load(85 / 125.0, {0.3, -5 * 0.4 / 85, 0.1});
  EXPECT_NEAR(violation(*afloat, part), 0, round_off);
  const Verdict v = afloat->verify(part, length_mm);
  EXPECT_TRUE(v.ok) << v.text;
  EXPECT_NEAR(v.values.at("offset_mm"), 0, length_mm * round_off);
  EXPECT_NEAR(v.values.at("centre_of_mass_z_mm"), length_mm * (85 * 0.1 + 5 * 0.5) / 100, 100 * round_off);
  EXPECT_NE(v.text.find("with 15 g on board"), std::string::npos) << v.text;
  for (const char* text : {"10", "10@1,2", "-1@0,0,0", "x@0,0,0"})
    expect_refused("float", {{"load", text}}, body,
                   std::string("problem.load = ") + text + "; expected grams");
}

TEST(Float, ADraftThatIsSoughtMustBeStable) {
  const Body body = barge();
  const auto& entry = find_problem("float");
  const std::vector<Settings> all = entry.choices(entry.read({{"draft", "auto"}}), body);
  ASSERT_EQ(all.size(), 6u);
  const auto asked = make_problem("float", {{"draft", "60%"}}, body), sought = entry.make(all[3], body);
  // 60 % of 0.5: the metacentre of draft() above.
  const double km = 0.15 + 1 / 3.6;
  const Moments low = load(0.6, {0.3, 0, km - 1e-3}), high = load(0.6, {0.3, 0, km + 1e-3});
  for (const Moments& s : {low, high}) EXPECT_NEAR(violation(*asked, s), 0, round_off);
  EXPECT_NEAR(violation(*sought, low), 0, round_off);
  EXPECT_NEAR(violation(*sought, high), 0.6e-3, round_off);
  EXPECT_EQ(sought->constraints().names.back(), "the centre of mass stays {} above the metacentre");
}

TEST(Float, LetGoItHeelsAndTrimsUntilItIsLiftedBelowItsCentre) {
  const Body body = barge();
  const auto afloat = make_problem("float", {{"draft", "60%"}}, body);
  const auto at_rest = [&](const Vec3& centre) {
    return afloat->verify_at_rest(load(0.6, centre), length_mm);
  };
  const Verdict upright = at_rest({0.3, 0, 0.2});
  EXPECT_TRUE(upright.ok);
  EXPECT_NEAR(upright.values.at("rest_tilt_degrees"), 0, 1e-9);
  EXPECT_EQ(upright.text, afloat->verify({load(0.6, {0.3, 0, 0.2})}, length_mm).text);
  // Small shifts turn it by shift over metacentric height, about either axis.
  const double heel = 1e-3 / (0.15 + 1 / (12 * 0.3) - 0.2), trim = 1e-3 / (0.15 + 4 / (12 * 0.3) - 0.2);
  const Verdict leans = at_rest({0.301, 0.001, 0.2});
  EXPECT_NEAR(leans.values.at("rest_heel_degrees"), heel * 180 / std::numbers::pi, 1e-3);
  EXPECT_NEAR(leans.values.at("rest_trim_degrees"), trim * 180 / std::numbers::pi, 1e-3);
  EXPECT_NE(leans.text.find("comes to rest with a heel of 0.25 and a trim of 0.05 degrees"),
            std::string::npos)
      << leans.text;
  const Verdict over = at_rest({0.3, 0, 0.9});
  EXPECT_GT(over.values.at("rest_tilt_degrees"), 90);
  EXPECT_NE(over.text.find("turns over"), std::string::npos) << over.text;
  EXPECT_NE(afloat->verify_at_rest(load(1.2, {0.3, 0, 0.2}), length_mm).text.find("it sinks"),
            std::string::npos);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
