// design_nest_test.cpp - `design nest` as a user runs it: parts that come apart, checked by what is in the
// files.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/run_design.hpp"
#include "body/mesh_moments.hpp"
#include "mesh/io/read.hpp"
#include "mesh/io/write.hpp"
#include "mesh/query/distance.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "nest/decide/exact.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;
using nlohmann::json;

Vec3 vector(const json& j) { return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()}; }

class DesignNest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path / name).string(); }
  [[nodiscard]] BenchAnswer run(const std::string& arguments) const {
    return design(
        fmt::format("nest {} --particles 24 --iterations 8 --cells 64 --printer-accuracy 0.8", arguments));
  }
  [[nodiscard]] json report() const {
    return json::parse(std::ifstream(file("report.json")), nullptr, false);
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_.path), {}));
  }

  const TemporaryFolder folder_;
};

TEST_F(DesignNest, HeedsKeepOuts) {
  const BenchAnswer a =
      run(fmt::format("duck --fineness 16 --keep-out 900,900,900,1 -o {}", file("duck.stl")));
  EXPECT_EQ(a.code, 2) << a.out;
  EXPECT_NE(a.out.find("no vertex of the outer shape lies in it"), std::string::npos) << a.out;
  EXPECT_EQ(files(), 0u);
}

TEST_F(DesignNest, TheUnitOfTheOuterShapeIsAskedForFirst) {
  for (const double size : {0.06, 60'000.0}) {
    write_mesh(file("part.off"), {box_mesh({0, 0, 0}, {size, size, size / 2})});
    for (const char* others : {"", "duck --fineness 12", "--wall 1.2mm"}) {
      const BenchAnswer a = run(fmt::format("{} {} -o {}", file("part.off"), others, file("doll.stl")));
      EXPECT_EQ(a.code, 2) << a.out;
      EXPECT_NE(
          a.out.find(size < 1 ? "does not say in what unit; expected --unit mm (0.06 mm), cm (0.6 mm), m (60 "
                                "mm), in (1.524 mm), or --size"
                              : "does not say in what unit; expected --unit mm (6e+04 mm)"),
          std::string::npos)
          << a.out;
      EXPECT_EQ(std::ranges::count(a.out, '\n'), 1) << a.out;
      EXPECT_EQ(files(), 1u);
    }
  }
  write_mesh(file("part.off"), {box_mesh({0, 0, 0}, {0.06, 0.06, 0.03})});
  // Whose size is said it is judged by that: of 60 and 50 mm.
  for (const auto& [said, wall] : {std::pair("--unit m", "0.6 mm"), {"--size 50", "0.5 mm"}}) {
    const BenchAnswer a = run(fmt::format("{} {} --wall 1% -o {}", file("part.off"), said, file("doll.stl")));
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find(fmt::format("a wall of {} is thinner", wall)), std::string::npos) << a.out;
  }
}

TEST_F(DesignNest, WritesPartsThatComeApart) {
  const BenchAnswer a = run(fmt::format("duck --fineness 20 --layers 2 --size 90 -o {} --json {}",
                                        file("duck.stl"), file("report.json")));
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("nests: 2 layers come apart"), std::string::npos) << a.out;
  const json j = report();
  EXPECT_TRUE(j.at("ok").get<bool>());
  ASSERT_EQ(j.at("layers").size(), 2u);
  ASSERT_EQ(j.at("parts").size(), 5u);
  EXPECT_EQ(files(), 6u) << "the parts and the report";
  for (const json& part : j.at("parts")) {
    const TriangleMesh mesh = read_mesh(part.at("file").get<std::string>());
    EXPECT_NO_THROW(require_solid(mesh, part.at("name").get<std::string>()));
    EXPECT_TRUE(self_intersections(mesh).empty()) << part.at("name");
    EXPECT_EQ(mesh.triangles.size(), part.at("triangles").get<std::size_t>());
    const double own = reference::mesh_moments(mesh).value[S1];
    EXPECT_NEAR(own, part.at("volume_mm3").get<double>(), 1e-6 * own);
  }
  const json& outer = j.at("layers")[0];
  for (const json& layer : j.at("layers")) {
    EXPECT_GE(layer.at("gap_mm").get<double>(), j.at("accuracy_mm").get<double>());
    EXPECT_GE(layer.at("wall_mm").get<double>(), j.at("wall_asked_mm").get<double>());
    EXPECT_EQ(layer.at("certified_scale"), layer.at("scale"));
  }
  // What lies in a half keeps clear of it on the whole way: the halves of layer 2, and what those hold, are
  // where the innermost shape is, and smaller than what layer 1 was carved for.
  const TriangleMesh innermost = read_mesh(file("duck-innermost.stl"));
  for (int half = 0; half < 2; ++half) {
    const TriangleMesh around =
        read_mesh(file(half == 0 ? "duck-layer-1-upper.stl" : "duck-layer-1-lower.stl"));
    const Vec3 away = vector(outer.at("removal").at(half == 0 ? "plus" : "minus"));
    const SurfaceDistance distance(around);
    for (const double way : {0.0, 1.0, 3.0, 10.0, 30.0})
      for (std::size_t v = 0; v < innermost.vertices.size(); v += 9) {
        const Vec3 p = innermost.vertices[v] - way * away;
        EXPECT_GE(distance(p, 1), j.at("accuracy_mm").get<double>()) << half << ' ' << way;
        if (v % 45 == 0) {
          EXPECT_LT(nest::winding_number(around, p), 0.5) << half << ' ' << way;
        }
      }
  }
}

TEST_F(DesignNest, PutsAllPartsIntoOne3mfAsObjects) {
  const std::string asked = fmt::format("heart duck --fineness 16 --size 80 --pegs 1 -o {} --json {}",
                                        file("all.3mf"), file("report.json"));
  // Its thinnest wall is half of what was asked: all is written, and said by the exit code.
  EXPECT_EQ(run(asked).code, 5);
  const BenchAnswer a = run(asked + " --accept --force");
  ASSERT_EQ(a.code, 0) << a.out;
  const json j = report();
  EXPECT_EQ(j.at("files"), json::array({file("all.3mf")}));
  const std::vector<TriangleMesh> objects = read_objects(file("all.3mf"));
  ASSERT_EQ(objects.size(), j.at("parts").size());
  EXPECT_EQ(j.at("parts")[0].at("name"), "layer-1-upper");
  EXPECT_EQ(j.at("parts")[2].at("name"), "layer-1-peg-1");
  EXPECT_EQ(j.at("parts").back().at("name"), "innermost");
  for (const TriangleMesh& mesh : objects) EXPECT_NO_THROW(require_solid(mesh, "object"));
}

TEST_F(DesignNest, SaysThatNothingFitsAndWritesNothing) {
  const BenchAnswer a = run(fmt::format("duck --fineness 12 --size 20 --wall 6 -o {}", file("duck.stl")));
  EXPECT_EQ(a.code, 3) << a.out;
  EXPECT_NE(a.out.find("nothing written"), std::string::npos) << a.out;
  EXPECT_EQ(files(), 0u);
}

TEST_F(DesignNest, RefusesInOneLine) {
  { std::ofstream(file("old-innermost.stl")) << "mine"; }
  struct Case {
    std::string arguments;
    const char* says;
  };
  for (const Case& c :
       {Case{"duck -o " + file("a.stl") + " --wall 0.2 --size 60", "thinner than the printer's accuracy"},
        Case{"duck -o " + file("a.stl") + " --wall 3h", "expected a number of mm, or percent"},
        Case{"duck -o " + file("old.stl"), "exists; expected a new name, or --force"},
        Case{"duck -o " + file("none/a.stl"), "expected an existing folder"},
        Case{"duk -o " + file("a.stl"), "did you mean 'duck'"}, Case{"duck -o " + file("a.txt"), "a.txt"}}) {
    const BenchAnswer a = run(c.arguments);
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find(c.says), std::string::npos) << a.out;
    EXPECT_EQ(std::ranges::count(a.out, '\n'), 1) << a.out;
  }
  EXPECT_EQ(files(), 1u);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
