// deform_test.cpp - `design --deform`: as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/json_vector.hpp"
#include "apps/run_design.hpp"
#include "deform/bodies.hpp"
#include "mesh/io/read.hpp"
#include "mesh/io/write.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class DeformedDesign : public ::testing::Test {
 protected:
  DeformedDesign() { write_mesh(file("leaning.off"), {leaning_ellipsoid({14, 16, 30}, 50, 40)}); }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path / name).string(); }
  [[nodiscard]] nlohmann::json report() const {
    return nlohmann::json::parse(std::ifstream(file("report.json")), nullptr, false);
  }
  [[nodiscard]] BenchAnswer make(const std::string& asked) const {
    return design(fmt::format("spin {} -o {} --json {} --html {} --force --resolution 32 --wall 1.5 {}",
                              file("leaning.off"), file("part.stl"), file("report.json"), file("part.html"),
                              asked));
  }

  const TemporaryFolder folder_;
};

TEST_F(DeformedDesign, SpinsWhereTheBodyAsItWasDoesNot) {
  const BenchAnswer as_it_is = make("");
  EXPECT_EQ(as_it_is.code, 3) << as_it_is.out;
  EXPECT_NE(as_it_is.out.find("--deform least, by at most"), std::string::npos) << as_it_is.out;

  const BenchAnswer a = make("--deform least");
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("shape      deformed: at most"), std::string::npos) << a.out;
  const nlohmann::json j = report(), d = j.at("deformation");
  EXPECT_TRUE(j.at("ok").get<bool>());
  EXPECT_EQ(d.at("reached"), "all");
  EXPECT_GT(d.at("largest_mm").get<double>(), 0.5);
  EXPECT_NEAR(d.at("volume_before_mm3").get<double>(), 4.0 / 3 * std::numbers::pi * 14 * 16 * 30, 500);
  // The outer surface of the part is the deformed body, closed, without crossings, and on its contact.
  const TriangleMesh part = read_mesh(file("part.stl"));
  EXPECT_TRUE(self_intersections(part).empty());
  const Vec3 contact = vector_of(j.at("contact"));
  double lowest = 1e9;
  for (const Vec3& v : part.vertices) lowest = std::min(lowest, v[2]);
  EXPECT_NEAR(lowest, contact[2], 0.02);
  // The page has both shapes.
  std::ifstream in(file("part.html"));
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(page.find("\"before\": {\"corners\""), std::string::npos);
}

TEST_F(DeformedDesign, SaysWhatIsOutOfReach) {
  const BenchAnswer a = make("--deform 1%");
  EXPECT_EQ(a.code, 3) << a.out;
  EXPECT_NE(a.out.find("more than allowed"), std::string::npos) << a.out;
}

TEST_F(DeformedDesign, RefusesWhatCannotBeDeformed) {
  for (const auto& [asked, part] :
       {std::pair{"--deform least --stem 2", "stem"}, std::pair{"--keep 0,0,0,3", "--deform"},
        std::pair{"--deform least --keep nowhere.stl", "nowhere.stl"},
        std::pair{"--deform least --formulation rayrep", "quadric"}, std::pair{"--deform 0%", "least"}}) {
    const BenchAnswer a = make(asked);
    EXPECT_EQ(a.code, 2) << asked << a.out;
    EXPECT_NE(a.out.find(part), std::string::npos) << asked << a.out;
    EXPECT_EQ(std::ranges::count(a.out, '\n'), 1) << asked << a.out;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
