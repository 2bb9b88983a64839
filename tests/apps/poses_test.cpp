// poses_test.cpp - `design` finds the pose: as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/run_design.hpp"
#include "body/body.hpp"
#include "body/test_meshes.hpp"
#include "mesh/io/read.hpp"
#include "mesh/io/write.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

class Poses : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path / name).string(); }
  [[nodiscard]] nlohmann::json report() const {
    return nlohmann::json::parse(std::ifstream(file("report.json")), nullptr, false);
  }
  [[nodiscard]] BenchAnswer make(const std::string& asked) const {
    return design(fmt::format("{} -o {} --json {} --force --resolution 32", asked, file("part.stl"),
                              file("report.json")));
  }

  const TemporaryFolder folder_;
};

TEST_F(Poses, AutoSpinsOnAStemThatIsWeighedAndWritten) {
  const BenchAnswer a = make("spin kitten --fineness 24 --axis auto --through centre");
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("axes through the centre of mass, on a stem were tried"), std::string::npos) << a.out;
  const nlohmann::json j = report();
  EXPECT_TRUE(j.at("after").at("ok").get<bool>());
  // The point of the stem is the lowest of the part along the axis, and on it: it stands on nothing else.
  const TriangleMesh part = read_mesh(file("part.stl"));
  const Vec3 axis(j.at("axis")[0], j.at("axis")[1], j.at("axis")[2]),
      contact(j.at("contact")[0], j.at("contact")[1], j.at("contact")[2]);
  const Vec3 lowest = lowest_point(part, axis);
  EXPECT_LE((lowest - contact).norm(), 1e-4) << "single precision";
  int near = 0;  // within a millimetre of the ground
  for (const Vec3& v : part.vertices) near += v.dot(axis) < lowest.dot(axis) + 1;
  EXPECT_EQ(near, 1) << "the cone's point";
}

TEST_F(Poses, AutoStandsAndFloatsHoweverTheFileIsTurned) {
  Random random(404);
  TriangleMesh post = box_mesh({-8, -10, -30}, {8, 10, 30});
  const Eigen::Matrix3d turn = random_rotation(random);
  for (Vec3& v : post.vertices) v = turn * v;
  write_mesh(file("post.off"), {post});
  BenchAnswer a = make(fmt::format("stand {}", file("post.off")));
  EXPECT_EQ(a.code, 3) << a.out;
  EXPECT_NE(a.out.find("has no base to stand on as it lies"), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("--flatten "), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("poses will do: the nearest"), std::string::npos) << a.out;
  EXPECT_FALSE(fs::exists(file("part.stl")));
  a = make(fmt::format("stand {} --up auto", file("post.off")));
  EXPECT_EQ(a.code, 0) << a.out;
  a = make(fmt::format("stand {} --flatten auto", file("post.off")));
  EXPECT_EQ(a.code, 0) << a.out;
  a = make(fmt::format("float {} --up auto --draft auto", file("post.off")));
  EXPECT_EQ(a.code, 0) << a.out;
}

TEST_F(Poses, WhatIsSuggestedWorks) {
  const BenchAnswer a = make("spin ellipsoid --fineness 16 --contact 12,19.5,0");
  ASSERT_EQ(a.code, 3) << a.out;
  const std::size_t at = a.out.find("--axis ");
  ASSERT_NE(at, std::string::npos) << a.out;
  const std::string options = a.out.substr(at, a.out.find(';', at) - at);
  EXPECT_EQ(make("spin ellipsoid --fineness 16 " + options).code, 0) << options;
}

TEST_F(Poses, NoneThatWillDoSaysHowManyWereTried) {
  // A stick spins about no axis: its moment about it is never the largest but across it, where it is
  // two-fold.
  const BenchAnswer a = make("balance cuboid --point 200,0,0");
  EXPECT_EQ(a.code, 3) << a.out;
  const BenchAnswer none = make("spin cuboid --axis near:1,0,0 --wall 6");
  EXPECT_EQ(none.code, 3) << none.out;
  EXPECT_NE(none.out.find("axes through the lowest point were tried, "), std::string::npos) << none.out;
  EXPECT_NE(none.out.find("a quadric that separates the two"), std::string::npos) << none.out;
  EXPECT_FALSE(fs::exists(file("part.stl")));
}

TEST_F(Poses, AStemThatCannotBeJoinedIsSaidWithTheCount) {
  // A ring about z: no stem along its axis, which runs through the hole.
  const TriangleMesh ring = upright_torus_mesh(20, 6, 48, 24);  // its axis is y
  write_mesh(file("ring.off"), {ring});
  const BenchAnswer a = make(fmt::format("spin {} --axis 0,1,0 --through centre --stem 2", file("ring.off")));
  EXPECT_EQ(a.code, 3) << a.out;
  EXPECT_NE(a.out.find("no stem can be joined"), std::string::npos) << a.out;
  EXPECT_FALSE(fs::exists(file("part.stl")));
}

TEST_F(Poses, BalanceHangAndDieMakeParts) {
  for (const char* asked :
       {"balance cuboid --point 33,20,15", "hang cuboid --point 33,20,30", "hang duck --fineness 24"}) {
    const BenchAnswer a = make(asked);
    EXPECT_EQ(a.code, 0) << a.out;
    EXPECT_LE(report().at("constraint_residual").at("centre_of_mass_mm").get<double>(), 1e-2) << asked;
  }
  // A wedge: its solid's faces come up unlike each other.
  TriangleMesh wedge = box_mesh({0, 0, 0}, {30, 30, 30});
  for (Vec3& v : wedge.vertices)
    if (v[2] > 1 && v[0] > 1) v[2] = 22;
  write_mesh(file("wedge.off"), {wedge});
  const BenchAnswer a = make(fmt::format("die {}", file("wedge.off")));
  ASSERT_EQ(a.code, 0) << a.out;
  const auto spread = [&](const char* which) {
    const nlohmann::json q = report().at(which).at("quality");
    return q.at("most_share").get<double>() - q.at("least_share").get<double>();
  };
  EXPECT_LT(spread("after"), 0.7 * spread("before")) << a.out;
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
