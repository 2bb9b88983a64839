#include "session/find_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body/test_meshes.hpp"
#include "geometry/moved.hpp"
#include "mesh/io/write.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class FindPose : public ::testing::Test {
 protected:
  /// A box of these edges, turned, asked by `field` = `value`.
  [[nodiscard]] RunConfig turned_box(const Vec3& edges, const Eigen::Matrix3d& turn,
                                     const char* problem) const {
    const std::filesystem::path file = folder_.path / "box.off";
    write_mesh(file, {moved(box_mesh(-edges / 2, edges / 2), turn)});
    RunConfig config;
    config.body.model = file.string();
    config.problem = problem;
    config.formulation = "quadric";
    config.grid.resolution = 32;
    config.wall = {2, Wall::millimetres};
    return config;
  }
  [[nodiscard]] static FoundPoses found(const RunConfig& config) {
    Session session;
    return find_poses(session, config, {});
  }

  const TemporaryFolder folder_;
};

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)) * 180 / std::numbers::pi;
}

TEST_F(FindPose, ToStandABoxLiesOnItsWidestFaceHoweverItIsTurned) {
  Random random(401);
  for (int trial = 0; trial < 3; ++trial) {
    const Eigen::Matrix3d turn = random_rotation(random);
    RunConfig config = turned_box({50, 20, 30}, turn, "stand");
    config.settings["problem.target"] = "max-tilt";
    set_field(config, "up", "auto");
    const FoundPoses poses = found(config);
    ASSERT_EQ(poses.good.size(), 6u) << poses.text();
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(std::abs(poses.good[i].direction.dot(turn.col(1))), 1, 1e-9) << "across its shortest edge";
    for (std::size_t i = 4; i < 6; ++i)
      EXPECT_NEAR(std::abs(poses.good[i].direction.dot(turn.col(0))), 1, 1e-9) << "on its smallest face";
    EXPECT_EQ(poses.tried.front().tried, 6u);
    EXPECT_EQ(poses.tried.front().spacing, 0) << "there are no others";
  }
}

TEST_F(FindPose, ToSpinASlabTurnsAboutItsShortestEdge) {
  Random random(402);
  const Eigen::Matrix3d turn = random_rotation(random);
  RunConfig config = turned_box({50, 50, 14}, turn, "spin");
  set_field(config, "axis", "auto");
  const FoundPoses poses = found(config);
  ASSERT_FALSE(poses.good.empty()) << poses.text();
  EXPECT_LE(std::min(degrees_between(poses.good[0].direction, turn.col(2)),
                     degrees_between(poses.good[0].direction, -turn.col(2))),
            0.1)
      << "a principal axis is tried as it is";
  EXPECT_EQ(poses.good[0].through, Through::lowest);
  ASSERT_TRUE(poses.onward) << "through the centre of mass is left to be tried";
  EXPECT_EQ(poses.onward->free->through, Through::centre);
}

TEST_F(FindPose, NearADirectionStaysWithinThirtyDegreesOfIt) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix();
  RunConfig config = turned_box({50, 50, 14}, turn, "spin");
  set_field(config, "axis", "near:0,0,1");
  for (const PoseCandidate& candidate : found(config).good)
    EXPECT_LE(degrees_between(candidate.direction, Vec3::UnitZ()), 30 + 1e-9);
  set_field(config, "axis", "near:1,0,0");
  const FoundPoses none = found(config);
  EXPECT_TRUE(none.good.empty()) << "a slab does not spin on its rim";
  EXPECT_NE(none.text().find("axes through the lowest point were tried"), std::string::npos) << none.text();
  EXPECT_NE(none.text().find("none will do"), std::string::npos) << none.text();
  EXPECT_NE(none.text().find("through the centre of mass"), std::string::npos) << none.text();
}

TEST_F(FindPose, ThroughTheCentreOfMassGetsAStem) {
  RunConfig config = turned_box({50, 50, 14}, Eigen::Matrix3d::Identity(), "spin");
  set_field(config, "axis", "near:0,0,1");
  set_field(config, "axis-through", "centre");
  const FoundPoses poses = found(config);
  ASSERT_FALSE(poses.good.empty()) << poses.text();
  const RunConfig question = posed(config, poses.good.front());
  EXPECT_NEAR(question.body.stem.radius.value_or(0), 0.03 * 50, 1e-9);
  EXPECT_FALSE(leaves_open(question));
  config.body.stem.radius = 2;
  EXPECT_EQ(posed(config, found(config).good.front()).body.stem.radius, 2) << "as asked";
}

TEST_F(FindPose, AnAxisThatIsGivenOnlyGetsItsPlace) {
  RunConfig config = turned_box({50, 50, 14}, Eigen::Matrix3d::Identity(), "spin");
  set_field(config, "axis", "0,0,-2");
  set_field(config, "axis-through", "centre");
  const FoundPoses poses = found(config);
  ASSERT_EQ(poses.good.size(), 1u) << poses.text();
  EXPECT_EQ(poses.good[0].direction, Vec3(0, 0, -1));
  EXPECT_TRUE(poses.good[0].stem);
}

TEST_F(FindPose, TheNthWayOfLyingIsByItsProbability) {
  RunConfig config = turned_box({50, 20, 30}, Eigen::Matrix3d::Identity(), "stand");
  config.settings["problem.target"] = "max-tilt";
  set_field(config, "up", "rest:6");
  const FoundPoses poses = found(config);
  ASSERT_EQ(poses.good.size(), 1u);
  EXPECT_NEAR(std::abs(poses.good[0].direction[0]), 1, 1e-9) << "the smallest face last";
  set_field(config, "up", "rest:7");
  expect_refusal([&] { (void)found(config); }, "--up rest:7", {"comes to rest in 6 ways; expected 1 to 6"});
}

TEST_F(FindPose, ToFloatDraftAndPoseAreChosenTogether) {
  RunConfig config = turned_box({20, 20, 60}, Eigen::Matrix3d::Identity(), "float");
  set_field(config, "up", "auto");
  set_field(config, "problem.draft", "auto");
  const FoundPoses poses = found(config);
  ASSERT_FALSE(poses.good.empty()) << poses.text();
  EXPECT_GE(degrees_between(poses.good[0].direction, Vec3::UnitZ()), 45) << "a post lies down";
  EXPECT_NE(find_problem("float").settings.in_force(poses.good[0].settings).at("draft"), "auto");
}

TEST_F(FindPose, ADraftThatAPoseDoesNotHaveIsImpossibleThere) {
  // 25 mm deep, of a body that is 20 mm high on most of its faces.
  RunConfig config = turned_box({20, 20, 60}, Eigen::Matrix3d::Identity(), "float");
  set_field(config, "up", "auto");
  set_field(config, "problem.draft", "25mm");
  const FoundPoses poses = found(config);
  EXPECT_GE(poses.tried.front().impossible, 4u) << poses.text();
  EXPECT_LT(poses.tried.front().impossible, poses.tried.front().tried);
}

TEST_F(FindPose, CutsOffNoMoreThanItMust) {
  // A roof turned over: it stands on its ridge.
  const std::filesystem::path file = folder_.path / "roof.off";
  TriangleMesh roof = box_mesh({-20, -20, 0}, {20, 20, 30});
  for (Vec3& v : roof.vertices)
    if (v[2] == 0) v[0] *= 1e-3;
  write_mesh(file, {roof});
  RunConfig config;
  config.body.model = file.string();
  config.problem = "stand";
  config.formulation = "quadric";
  config.wall = {2, Wall::millimetres};
  config.settings["problem.target"] = "max-tilt";
  set_field(config, "up", "0,0,1");
  set_field(config, "flatten", "auto");
  const FoundPoses poses = found(config);
  ASSERT_EQ(poses.good.size(), 1u) << poses.text();
  // 40 long and 4/3 wide a millimetre up: a base of a hundredth of a body length, L = 29 mm, is met at once.
  EXPECT_LT(poses.good[0].flatten.value_or(99), 1);
  EXPECT_GT(poses.good[0].flatten.value_or(0), 0);
}

TEST_F(FindPose, OfAProblemThatIsAskedInOnePoseIsRefused) {
  RunConfig config = turned_box({50, 20, 30}, Eigen::Matrix3d::Identity(), "balance");
  set_field(config, "up", "auto");
  expect_refusal([&] { (void)found(config); }, "problem balance with a pose that is to be found",
                 {"expected a direction"});
}

/// Least moment about the axis, by nobody's but the test's: as a user registers one.
class Slender final : public Problem {
 public:
  [[nodiscard]] std::string_view name() const override { return "slender"; }
  [[nodiscard]] double value(const Moments& s) const override { return s[S1]; }
  [[nodiscard]] Moments gradient(const Moments&) const override { return Moments::Unit(S1); }
  [[nodiscard]] Matrix10 hessian(const Moments&) const override { return Matrix10::Zero(); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return none_; }
  [[nodiscard]] double pose_loss(const Moments& s) const override {
    const Eigen::Matrix3d i = inertia_about_centre(s);
    return i(2, 2) / i.trace();
  }
  [[nodiscard]] Verdict verify(const Moments&, double) const override { return {true, "is", {}}; }

 private:
  LinearConstraints none_{decltype(LinearConstraints::matrix)(0, 10), {}, {}, {}};
};

TEST_F(FindPose, OfARegisteredProblemGoesByItsOwnLoss) {
  ProblemEntry entry;
  entry.name = "slender";
  entry.make = [](const Settings&, const Body&) { return std::make_unique<Slender>(); };
  entry.poses = Poses::any;
  problems().add(std::move(entry));
  Random random(403);
  const Eigen::Matrix3d turn = random_rotation(random);
  RunConfig config = turned_box({60, 20, 20}, turn, "slender");
  set_field(config, "axis", "auto");
  const FoundPoses poses = found(config);
  ASSERT_FALSE(poses.good.empty()) << poses.text();
  EXPECT_LE(std::min(degrees_between(poses.good[0].direction, turn.col(0)),
                     degrees_between(poses.good[0].direction, -turn.col(0))),
            0.5);
}

TEST(FreePose, IsPartOfWhatARunIs) {
  RunConfig config;
  set_field(config, "axis", "near:0,1,0");
  set_field(config, "axis-through", "centre");
  set_field(config, "tip", "1,2.5");
  set_field(config, "flatten", "auto");
  const auto fields = describe(config);
  EXPECT_EQ(fields.at("axis"), "near:0,1,0");
  EXPECT_EQ(fields.at("axis-through"), "centre");
  EXPECT_EQ(fields.at("tip"), "1,2.5");
  EXPECT_EQ(fields.at("flatten"), "auto");
  RunConfig again;
  for (const char* name : {"axis", "axis-through", "tip", "flatten"}) set_field(again, name, fields.at(name));
  EXPECT_EQ(describe(again), fields);
  set_field(again, "axis", "0,0,1");
  EXPECT_TRUE(again.free && !again.free->near) << "where it runs is still to be found";
  EXPECT_EQ(describe(again).at("axis"), "0,0,1");
  RunConfig third;
  set_field(third, "up", "rest:2");
  set_field(third, "up", "0,0,1");
  EXPECT_FALSE(third.free) << "a direction takes its place";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
