#include "deform/deform.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "body/models/shapes.hpp"
#include "deform/bodies.hpp"
#include "device/scoped_environment.hpp"
#include "error.hpp"
#include "problem/problem.hpp"
#include "refusal.hpp"
#include "session/deformed.hpp"
#include "session/solved_run.hpp"
#include "temporary_folder.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// What is leaning so that no interior lets it spin on its lowest point.
std::shared_ptr<const Source> leaning() {
  return std::make_shared<const Source>(source_of(leaning_ellipsoid({14, 16, 30}, 50, 40)));
}

RunConfig question(const char* problem, const char* deform) {
  RunConfig config;
  config.problem = problem;
  config.formulation = "quadric";
  config.grid.resolution = 32;
  config.wall = {1.5, Wall::millimetres};
  if (deform) set_field(config, "deform", deform);
  return config;
}

std::shared_ptr<device::Device> shared_device() { return {std::shared_ptr<void>(), &test_device()}; }

/// What becomes of a question without a deformation.
Termination ending_of(Session& session, const RunConfig& config) {
  SolvedRun run(session, config);
  run.solve();
  return run.result.outcome.termination;
}

double mirror_error(const TriangleMesh& mesh) {
  double worst = 0;
  for (const Vec3& v : mesh.vertices) {
    double nearest = 1e9;
    for (const Vec3& w : mesh.vertices) nearest = std::min(nearest, (Vec3(v[0], -v[1], v[2]) - w).norm());
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(Deform, MakesABodySpinThatNoInteriorLetsSpin) {
  Session session(leaning(), shared_device());
  ASSERT_EQ(ending_of(session, question("spin", nullptr)), Termination::infeasible);

  SolvedRun run(session, question("spin", "least"));
  run.solve();
  ASSERT_TRUE(run.result.deformation);
  const DeformationReport& report = *run.result.deformation;
  EXPECT_EQ(report.reached, Reached::all);
  EXPECT_EQ(run.result.outcome.termination, Termination::optimal);
  EXPECT_TRUE(run.problem().verify(run.result.outcome.moments, run.result.length_mm).ok);
  EXPECT_GT(report.largest_percent, 1);
  EXPECT_LT(report.largest_percent, 20);
  EXPECT_GE(report.least_determinant, 0.5);
  // The largest displacement is that of the two meshes, up to the translation between them.
  Vec3 lo = Vec3::Constant(1e9), hi = -lo;
  for (std::size_t i = 0; i < report.before.vertices.size(); ++i) {
    const Vec3 d = run.body().mesh.vertices[i] - report.before.vertices[i];
    lo = lo.cwiseMin(d);
    hi = hi.cwiseMax(d);
  }
  double largest = 0;
  for (std::size_t i = 0; i < report.before.vertices.size(); ++i)
    largest =
        std::max(largest, (run.body().mesh.vertices[i] - report.before.vertices[i] - (lo + hi) / 2).norm());
  EXPECT_NEAR(largest, report.largest_mm, 1e-9 * largest);
  // It is its own mirror image, and so is what it becomes, nearly: a quadric that separates to one side may
  // come without the one that separates to the other.
  EXPECT_LT(mirror_error(run.body().mesh), 0.03 * 60);
}

TEST(Deform, MovesTheCornersOfACageAsWell) {
  const TemporaryFolder folder;
  const ScopedEnvironment cache("KREISEL_CACHE_DIR", folder.path.string());
  Session session(leaning(), shared_device());
  RunConfig config = question("spin", "least");
  config.settings["deform.handles"] = "cage";
  SolvedRun run(session, config);
  run.solve();
  const DeformationReport& report = *run.result.deformation;
  EXPECT_EQ(report.reached, Reached::all) << report.text();
  EXPECT_LT(report.largest_percent, 25);
  EXPECT_GT(report.energy, 0);
  EXPECT_FALSE(report.joint);
  EXPECT_TRUE(run.problem().verify(run.result.outcome.moments, run.result.length_mm).ok);
}

TEST(Deform, AsPublishedFindsFillsAndHandlesTogether) {
  const TemporaryFolder folder;
  const ScopedEnvironment cache("KREISEL_CACHE_DIR", folder.path.string());
  Source dancers = source_of(dancers_shape(10));
  dancers.size = 60;
  Session session(std::make_shared<const Source>(std::move(dancers)), shared_device());
  RunConfig config = question("spin", nullptr);
  config.body.size = 60;
  config.formulation = "octree";
  config.wall = {2, Wall::millimetres};
  ASSERT_EQ(ending_of(session, config), Termination::infeasible);
  set_field(config, "deform", "least");
  SolvedRun run(session, config);
  run.solve();
  const DeformationReport& report = *run.result.deformation;
  ASSERT_NE(report.reached, Reached::nothing) << report.text();
  ASSERT_TRUE(report.joint);
  EXPECT_LT(report.joint->violation, 1e-6);
  EXPECT_LT(report.largest_percent, 10);
  EXPECT_TRUE(run.result.outcome.converged());
  EXPECT_LT(run.result.outcome.violation, 1e-6);
}

TEST(Deform, AsPublishedTakesNoLimitAndKeepsNothing) {
  Session session(leaning(), shared_device());
  RunConfig config = question("spin", "least");
  config.formulation = "octree";
  config.wall = {2, Wall::millimetres};
  RunConfig kept = config;
  set_field(kept, "keep", "0,0,0,1");
  expect_refusal([&] { SolvedRun(session, kept); }, "--deform", {"quadric"});
  RunConfig within = config;
  set_field(within, "deform", "5%");
  expect_refusal([&] { SolvedRun(session, within); }, "--deform", {"quadric"});
  RunConfig coarse = config;
  coarse.settings["deform.grid"] = "6";
  expect_refusal([&] { SolvedRun(session, coarse); }, "--deform at a resolution", {"deform.grid = 5"});
  RunConfig level = config;
  level.settings["deform.level"] = "5";
  expect_refusal([&] { SolvedRun(session, level); }, "deform.grid", {"at least"});
}

TEST(Deform, WithinALimitMakesTheObjectiveBetter) {
  Session session(leaning(), shared_device());
  SolvedRun least(session, question("spin", "least"));
  least.solve();
  const double far = least.result.deformation->largest_percent;
  RunConfig more = question("spin", fmt::format("{}%", 1.3 * far).c_str());
  SolvedRun run(session, more);
  run.solve();
  EXPECT_EQ(run.result.deformation->reached, Reached::all);
  EXPECT_LE(run.result.deformation->largest_percent, 1.3 * far * (1 + 1e-9));
  EXPECT_LT(run.result.outcome.objective, 0.9 * least.result.outcome.objective);

  SolvedRun less(session, question("spin", fmt::format("{}%", 0.3 * far).c_str()));
  less.solve();
  EXPECT_EQ(less.result.deformation->reached, Reached::nothing);
  EXPECT_TRUE(less.result.deformation->too_far);
  EXPECT_EQ(less.result.outcome.termination, Termination::infeasible);
}

TEST(Deform, LeavesABodyAsItIsThatAnInteriorLetsSpin) {
  const auto round = std::make_shared<const Source>(source_of(leaning_ellipsoid({25, 25, 15}, 0, 40)));
  Session session(round, shared_device());
  SolvedRun run(session, question("spin", "least"));
  run.solve();
  EXPECT_EQ(run.result.deformation->reached, Reached::all);
  EXPECT_EQ(run.result.deformation->largest_mm, 0);
  for (std::size_t i = 0; i < round->mesh.vertices.size(); ++i)
    EXPECT_LT((run.body().mesh.vertices[i] - round->mesh.vertices[i]).norm(), 1e-12 * 60);
  RunConfig cells = question("spin", "least");
  cells.formulation = "octree";
  cells.wall = {2, Wall::millimetres};
  const SolvedRun as_published(session, cells);
  EXPECT_EQ(as_published.result.deformation->reached, Reached::all);
  EXPECT_EQ(as_published.result.deformation->largest_mm, 0);
}

TEST(Deform, LeavesWhatIsKeptExactlyWhereItIs) {
  Session session(leaning(), shared_device());
  RunConfig config = question("spin", "least");
  set_field(config, "keep", "15,0,20,8");
  SolvedRun run(session, config);
  const DeformationReport& report = *run.result.deformation;
  ASSERT_NE(report.reached, Reached::nothing);
  int kept = 0;
  double moved = 0;
  for (std::size_t i = 0; i < report.before.vertices.size(); ++i) {
    const Vec3& before = report.before.vertices[i];
    const double by = (run.body().mesh.vertices[i] - before).norm();
    moved = std::max(moved, by);
    if ((before - Vec3(15, 0, 20)).norm() > 8) continue;
    ++kept;
    EXPECT_LT(by, 1e-12 * 60);
  }
  EXPECT_GT(kept, 5);
  EXPECT_GT(moved, 0.5);
}

TEST(Deform, MakesABodyStandAndLeavesItsBaseAsItIs) {
  // A leaning box, whose centre of mass is beside its base.
  TriangleMesh box = box_mesh({-8, -8, 0}, {8, 8, 50});
  for (Vec3& v : box.vertices) v[0] += 0.75 * v[2];
  const auto tower = std::make_shared<const Source>(source_of(box));
  Session session(tower, shared_device());
  RunConfig config = question("stand", nullptr);
  config.settings["problem.target"] = "inside";
  ASSERT_EQ(ending_of(session, config), Termination::infeasible);
  set_field(config, "deform", "least");
  SolvedRun run(session, config);
  run.solve();
  EXPECT_EQ(run.result.deformation->reached, Reached::all) << run.result.deformation->text();
  EXPECT_TRUE(run.problem().verify(run.result.outcome.moments, run.result.length_mm).ok);
  const TriangleMesh& before = run.result.deformation->before;
  ASSERT_EQ(before.vertices.size(), run.body().mesh.vertices.size());
  for (std::size_t i = 0; i < before.vertices.size(); ++i)
    if (before.vertices[i][2] < 1e-9) {
      EXPECT_LT((run.body().mesh.vertices[i] - before.vertices[i]).norm(), 1e-12 * 60);
    }
}

TEST(Deform, RefusesWhatItCannotDo) {
  Session session(leaning(), shared_device());
  RunConfig kept = question("spin", nullptr);
  set_field(kept, "keep", "0,0,0,1");
  expect_refusal([&] { SolvedRun(session, kept); }, "--keep", {"--deform"});
  RunConfig rays = question("spin", "least");
  rays.formulation = "rayrep";
  expect_refusal([&] { SolvedRun(session, rays); }, "--deform", {"quadric"});
  RunConfig ball = question("spin", "least");
  set_field(ball, "keep", "0,0,0,-1");
  expect_refusal([&] { SolvedRun(session, ball); }, "--keep", {"x,y,z,r"});
  RunConfig config = question("spin", nullptr);
  for (const char* text : {"0%", "-3%", "60%", "much", ""})
    expect_refusal([&] { set_field(config, "deform", text); }, "deform", {"least"});
}

TEST(Deform, WhatIsAllKeptCannotBeDeformed) {
  Session session(leaning(), shared_device());
  RunConfig config = question("spin", "least");
  set_field(config, "keep", "0,0,0,100");
  expect_refusal([&] { SolvedRun(session, config); }, "--keep", {"all of the body"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
