#include "session/session.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "body/test_meshes.hpp"
#include "error.hpp"
#include "session/solved_run.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Made = std::vector<std::string_view>;

RunConfig question(const char* problem = "spin") {
  RunConfig config;
  config.body.fineness = 16;
  config.grid.resolution = 32;
  config.wall = {3, Wall::millimetres};
  config.formulation = "quadric";
  config.problem = problem;
  return config;
}

Outcome ask(Session& session, const RunConfig& config) {
  SolvedRun run(session, config, {}, Along::any_axis);
  run.solve();
  return run.result.outcome;
}

Outcome ask_cold(const RunConfig& config) {
  Session session;
  SolvedRun run(session, config);
  run.solve();
  return run.result.outcome;
}

class OfASession : public testing::Test {
 protected:
  /// Asks, and compares with a session that has never been asked.
  /// @param tolerance  of the objective, relative; 0: the same bits
  void same_as_cold(const RunConfig& config, const Made& made, double tolerance = 0) {
    const Outcome warm = ask(session_, config), cold = ask_cold(config);
    EXPECT_EQ(session_.made(), made);
    EXPECT_EQ(warm.termination, cold.termination);
    if (tolerance > 0)
      EXPECT_NEAR(warm.objective, cold.objective, tolerance * std::abs(cold.objective));
    else
      EXPECT_EQ(warm.objective, cold.objective);
  }

  Session session_;
};

TEST_F(OfASession, TheSolidAloneIsReadOnceAndNothingElseOfTheQuestionIsJudged) {
  RunConfig config = question();
  config.device = "none of that name";
  config.wall = {1000, Wall::millimetres};
  const std::shared_ptr<const Source> solid = session_.solid(config);
  EXPECT_EQ(solid->mesh.triangles, load_solid(config.body).mesh.triangles);
  EXPECT_EQ(session_.solid(question()), solid);
  same_as_cold(question(), {"device", "body", "domain", "problem", "formulation"});
}

TEST_F(OfASession, TheFirstQuestionMakesAllAndTheSameAgainNothing) {
  same_as_cold(question(), {"device", "mesh", "body", "domain", "problem", "formulation"});
  same_as_cold(question(), {});
}

TEST_F(OfASession, AWeightMakesAProblem) {
  ask(session_, question());
  RunConfig heavier = question();
  heavier.settings["problem.gamma_i"] = "2";
  same_as_cold(heavier, {"problem"});
}

TEST_F(OfASession, ADraftMakesAProblem) {
  RunConfig at = question("float");
  at.settings["problem.draft"] = "50%";
  ask(session_, at);
  at.settings["problem.draft"] = "60%";
  same_as_cold(at, {"problem"});
}

TEST_F(OfASession, DensitiesMakeAPose) {
  ask(session_, question());
  RunConfig denser = question();
  denser.body.interior_density = 2.5;
  same_as_cold(denser, {"pose", "problem"});
}

TEST_F(OfASession, AnotherAxisKeepsTheRays) {
  ask(session_, question());
  RunConfig turned = question();
  turned.body.axis = Vec3(0.1, 0.2, 1);
  turned.body.contact = Vec3(1, 0, -2);
  // The rays of another axis sample the same shape: to first order in a cell, of 32.
  same_as_cold(turned, {"pose", "problem"}, 0.02);
}

// Two percent of the longest side, and one cell, are another length in another frame.
TEST_F(OfASession, AnotherAxisMakesTheDomainOfAWallThatIsNoLength) {
  for (const Wall wall : {Wall{2, Wall::percent}, Wall{1.5, Wall::cells}}) {
    session_ = Session();
    RunConfig turned = question();
    turned.wall = wall;
    turned.body.axis = Vec3(0, 0, 1);
    ask(session_, turned);
    turned.body.axis = Vec3(0.1, 0.2, 1);
    same_as_cold(turned, {"pose", "domain", "problem", "formulation"}, 1e-9);
  }
}

TEST_F(OfASession, APartKeepsTheDomain) {
  ask(session_, question());
  RunConfig of_part = question();
  of_part.wall.to_corners = true;  // as a part asks for, and exact rays have no corners
  same_as_cold(of_part, {});
}

TEST_F(OfASession, AnotherAxisMakesTheDomainOfWhatIsNoQuadric) {
  RunConfig turned = question();
  turned.formulation = "rayrep";
  ask(session_, turned);
  turned.body.axis = Vec3(0.1, 0.2, 1);
  same_as_cold(turned, {"pose", "domain", "problem", "formulation"}, 1e-6);
}

TEST_F(OfASession, ABaseThatWouldLayRaysAlongTheCutMakesTheDomain) {
  RunConfig at = question("float");
  at.settings["problem.draft"] = "50%";
  ask(session_, at);
  at.body.up = Vec3(1, 0, 0.1);
  same_as_cold(at, {"pose", "domain", "problem", "formulation"}, 1e-9);
}

TEST_F(OfASession, AWallMakesTheDomain) {
  ask(session_, question());
  RunConfig thicker = question();
  thicker.wall = {2, Wall::cells};
  same_as_cold(thicker, {"domain", "formulation"});
}

TEST_F(OfASession, WallAfterWallAnswersAsFreshSessionsDo) {
  ask(session_, question());
  RunConfig other = question();
  for (const double mm : {1.5, 5.0, 0.2, 3.0}) {
    other.wall.value = mm;
    same_as_cold(other, {"domain", "formulation"});
  }
  other.grid.resolution = 24;
  same_as_cold(other, {"domain", "formulation"});
  other.body.axis = Vec3(0.3, 0, 1);
  other.wall = {2, Wall::percent};
  same_as_cold(other, {"pose", "domain", "problem", "formulation"}, 1e-9);  // laid anew, as above
}

TEST_F(OfASession, ASizeMakesAllButTheMesh) {
  ask(session_, question());
  RunConfig larger = question();
  larger.body.size = 90;
  same_as_cold(larger, {"body", "domain", "problem", "formulation"});
}

TEST_F(OfASession, AMistakeLeavesItUsable) {
  ask(session_, question());
  RunConfig wrong = question();
  wrong.wall = {60, Wall::percent};
  EXPECT_THROW((void)ask(session_, wrong), InputError);
  wrong = question();
  wrong.problem = "spim";
  EXPECT_THROW((void)ask(session_, wrong), InputError);
  same_as_cold(question(), {"domain", "formulation"});
}

TEST_F(OfASession, AStopEndsTheQuestionAndLeavesItUsable) {
  std::stop_source stop;
  stop.request_stop();
  Control control;
  control.stop = stop.get_token();
  EXPECT_THROW(SolvedRun(session_, question(), control), Interrupted);
  EXPECT_EQ(ask(session_, question()).termination, Termination::optimal);
}

// Each session has its own queue and kernels; MUMPS is taken in turns.
TEST(Sessions, InEightThreadsGiveTheSameBitsAsInSequence) {
  const auto asked = [](int i) {
    RunConfig config = question(i % 3 == 0 ? "float" : "spin");
    if (i % 3 == 0) config.settings["problem.draft"] = std::to_string(50 + i % 7) + "%";
    if (i % 3 == 1) config.settings["problem.gamma_i"] = std::to_string(1 + i % 5);
    if (i % 25 == 2) config.formulation = "rayrep";
    if (i % 3 == 2) config.body.interior_density = 1.5 + 0.1 * (i % 4);
    return config;
  };
  constexpr int count = 200, threads = 8;
  std::vector<Outcome> alone(count), together(count);
  Session one;
  for (int i = 0; i < count; ++i) alone[i] = ask(one, asked(i));
  {
    std::vector<std::jthread> all;
    for (int t = 0; t < threads; ++t)
      all.emplace_back([&, t] {
        Session own;
        for (int i = t; i < count; i += threads) together[i] = ask(own, asked(i));
      });
  }
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(alone[i].termination, together[i].termination) << i;
    EXPECT_EQ(alone[i].objective, together[i].objective) << i;
    EXPECT_EQ(alone[i].x, together[i].x) << i;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
