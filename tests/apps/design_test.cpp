// design_test.cpp - `design` as a user runs it: a mesh in, a verified part out, and what others say of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/run_design.hpp"
#include "body/mesh_moments.hpp"
#include "mesh/io/read.hpp"
#include "mesh/io/write.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/components.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

class Design : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path / name).string(); }
  [[nodiscard]] nlohmann::json report() const {
    return nlohmann::json::parse(std::ifstream(file("report.json")), nullptr, false);
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_.path), {}));
  }

  const TemporaryFolder folder_;
};

/// A cavity's mesh is as fine as its wall is thin: this one of a third of the default's triangles.
constexpr const char* coarse = "--resolution 48 --fineness 24 --wall 2.4mm --force";
/// Where whole cells leave no room for such a wall.
constexpr const char* of_cells = "--resolution 48 --fineness 24 --force";

struct Case {
  const char *problem, *model, *options, *says, *formulation = "quadric";
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.problem << ' ' << c.model << " by " << c.formulation;
}

class DesignOf : public Design, public ::testing::WithParamInterface<Case> {};

TEST_P(DesignOf, IsWhatItsReportSays) {
  const auto& [problem, model, options, says, formulation] = GetParam();
  const BenchAnswer a = design(fmt::format(
      "{} {} -o {} --json {} --formulation {} {} {}", problem, model, file("part.stl"), file("report.json"),
      formulation, formulation == std::string("quadric") ? coarse : of_cells, options));
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find(says), std::string::npos) << a.out;
  const nlohmann::json j = report();
  EXPECT_EQ(j.at("formulation"), formulation);
  EXPECT_TRUE(j.at("after").at("ok").get<bool>()) << a.out;
  const auto& residual = j.at("constraint_residual");
  EXPECT_LE(residual.at("centre_of_mass_mm").get<double>(), 0.01);
  if (!residual.at("axis_degrees").is_null()) {
    EXPECT_LE(residual.at("axis_degrees").get<double>(), 0.05);
  }
  EXPECT_GE(j.at("wall_mm").get<double>(), j.at("wall_asked_mm").get<double>() - 1e-5);

  // The file itself, integrated here: floats of up to 60 mm, 4e-6 mm a coordinate.
  if (std::string(options).find("--axle") != std::string::npos) return;  // the axle is a part of its own
  const Moments s =
      1e-3 * j.at("density").get<double>() * reference::mesh_moments(read_mesh(file("part.stl"))).value;
  const auto& after = j.at("after");
  EXPECT_NEAR(s[S1], after.at("mass_g").get<double>(), 1e-6 * s[S1]);
  EXPECT_NEAR(1e3 * s[S1] / j.at("density").get<double>(), after.at("volume_mm3").get<double>(), 1e-2);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(centre_of_mass(s)[k], after.at("centre_of_mass_mm")[k].get<double>(), 1e-5);
  const Eigen::Matrix3d inertia = inertia_about_centre(s);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(inertia(i, k), after.at("inertia_g_mm2")[i][k].get<double>(), 1e-6 * inertia.trace());
  EXPECT_LT(after.at("mass_g").get<double>(), j.at("before").at("mass_g").get<double>());
}

INSTANTIATE_TEST_SUITE_P(All, DesignOf,
                         ::testing::Values(Case{"spin", "ellipsoid", "",
                                                "spins: centre of mass 0.000 mm off the axis"},
                                           Case{"yoyo", "cuboid", "--axis 0.1,0,1 --axle 3", "spins: "},
                                           Case{"stand", "teapot", "", "stands: "},
                                           Case{"float", "duck", "--draft 50%", "floats: "},
                                           Case{"spin", "ellipsoid", "", "spins: ", "octree"},
                                           Case{"spin", "ellipsoid", "", "spins: ", "rayrep"},
                                           Case{"spin", "ellipsoid", "", "spins: ", "voxel"},
                                           Case{"stand", "teapot", "", "stands: ", "voxel"}));

TEST_F(Design, WritesEveryFormat) {
  double mass = 0;
  for (const char* name : {"part.stl", "part.3mf", "part.obj", "part.ply", "part.off"}) {
    const BenchAnswer a = design(
        fmt::format("spin ellipsoid -o {} --resolution 24 --fineness 16 --wall 2.4mm --force", file(name)));
    ASSERT_EQ(a.code, 0) << a.out;
    const double volume = reference::mesh_moments(read_mesh(file(name))).value[S1];
    if (mass > 0) {
      EXPECT_NEAR(volume, mass, 1e-5 * mass);
    }
    mass = volume;
  }
}

TEST_F(Design, PiecesLaidFlatLieOnTheirCutsBesideEachOther) {
  const BenchAnswer a = design(fmt::format("spin ellipsoid -o {} --json {} --cut auto --pegs 1 --lay-flat {}",
                                           file("part.stl"), file("report.json"), coarse));
  ASSERT_EQ(a.code, 0) << a.out;
  const nlohmann::json j = report();
  EXPECT_TRUE(j.at("after").at("ok").get<bool>()) << "of the pieces put together";
  ASSERT_EQ(j.at("files").size(), 4u);
  for (const auto& [field, text] : {std::pair{"cut", "auto"},
                                    {"pegs", "1"},
                                    {"lay-flat", "true"},
                                    {"wall-to", "corners"},
                                    {"printer-accuracy", "0.4"}})
    EXPECT_EQ(j.at("config").at(field), text) << "what reproduces the part";
  double end = -1;
  for (const auto& name : j.at("files")) {
    const TriangleMesh mesh = read_mesh(name.get<std::string>());
    const Box box = bounding_box(mesh);
    EXPECT_EQ(box.lo[2], 0);
    EXPECT_GT(std::ranges::count_if(mesh.vertices, [](const Vec3& v) { return v[2] == 0; }), 20)
        << "of a cap or a peg";
    EXPECT_GT(box.lo[0], end);
    end = box.hi[0];
  }
}

TEST_F(Design, NamesItsPegAndSaysWhenACutRunsThroughItsPoint) {
  // The peg stands at x = 27.05: one cut along it, one through the middle of the body.
  const std::string warning = "a cut runs through the peg's point";
  for (const auto& [cut, through] : {std::pair{"1,0,0,28.2", true}, {"0,0,1,18", false}}) {
    const BenchAnswer a = design(fmt::format("spin ellipsoid -o {} --json {} --stem 2 --cut {} {}",
                                             file("part.stl"), file("report.json"), cut, coarse));
    ASSERT_EQ(a.code, 0) << a.out;
    EXPECT_NE(a.out.find("peg        of 2 mm radius"), std::string::npos) << a.out;
    EXPECT_EQ(a.out.find(warning) != std::string::npos, through) << cut;
    EXPECT_EQ(report().at("pieces_mm3").size(), 2u);
  }
}

TEST_F(Design, CutOpenIsStillBalanced) {
  const BenchAnswer a = design(fmt::format("spin ellipsoid -o {} --json {} --cut auto --pegs 1.5 {}",
                                           file("part.stl"), file("report.json"), coarse));
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_FALSE(fs::exists(file("part.stl"))) << "there are only halves";
  const nlohmann::json j = report();
  EXPECT_EQ(j.at("files").size(), 4u) << "halves and pegs";
  EXPECT_EQ(j.at("cut_by").size(), 1u);
  EXPECT_LE(j.at("constraint_residual").at("centre_of_mass_mm").get<double>(), 0.01);
  EXPECT_LE(j.at("constraint_residual").at("axis_degrees").get<double>(), 0.05);
  Moments s = Moments::Zero();
  for (const char* half : {"part-upper.stl", "part-lower.stl"}) {
    const TriangleMesh mesh = read_mesh(file(half));
    EXPECT_EQ(shells(mesh).size(), 1u) << "its void is open";
    s += 1e-3 * reference::mesh_moments(mesh).value;
  }
  for (const char* peg : {"part-peg-1.stl", "part-peg-2.stl"})
    s += 1e-3 * reference::mesh_moments(read_mesh(file(peg))).value;
  EXPECT_NEAR(s[S1], j.at("after").at("mass_g").get<double>(), 1e-6 * s[S1]);
}

TEST_F(Design, DrainedIsStillBalanced) {
  const BenchAnswer a = design(fmt::format("spin ellipsoid -o {} --json {} --drain 1.5 {}", file("part.stl"),
                                           file("report.json"), coarse));
  ASSERT_EQ(a.code, 0) << a.out;
  const nlohmann::json j = report();
  EXPECT_EQ(j.at("drains").size(), 1u);
  EXPECT_LE(j.at("constraint_residual").at("centre_of_mass_mm").get<double>(), 0.01);
  EXPECT_LE(j.at("constraint_residual").at("axis_degrees").get<double>(), 0.05);
  const TriangleMesh mesh = read_mesh(file("part.stl"));
  const std::vector<Shell> all = shells(mesh);
  ASSERT_EQ(all.size(), 1u) << "the void is open to the outside";
  EXPECT_EQ(all[0].genus, 0) << "a ball with one dent";
  EXPECT_TRUE(self_intersections(mesh).empty());
}

TEST_F(Design, WritesAMouldForAHeavyInteriorBesideAShellCutOpen) {
  const BenchAnswer a = design(fmt::format(
      "spin ellipsoid -o {} --json {} --density 1.17 --interior-density 8.1 --mould --cut auto {}",
      file("part.stl"), file("report.json"), coarse));
  ASSERT_EQ(a.code, 0) << a.out;
  const nlohmann::json j = report();
  EXPECT_TRUE(j.at("after").at("ok").get<bool>()) << "of the halves and what goes into them";
  EXPECT_EQ(j.at("files").size(), 3u) << "halves of the shell, interior";
  ASSERT_EQ(j.at("moulds").size(), 1u);
  const nlohmann::json& mould = j.at("moulds")[0];
  EXPECT_EQ(mould.at("of"), "interior");
  const double casting = reference::mesh_moments(read_mesh(file("part-interior.stl"))).value[S1];
  EXPECT_NEAR(mould.at("casting_mm3").get<double>(), casting, 1e-5 * casting);
  EXPECT_NEAR(mould.at("cavity_mm3").get<double>(), casting, 5e-3 * casting) << "edges are blunt";
  ASSERT_EQ(mould.at("files").size(), 4u) << "halves and pins";
  // What the halves leave of the block they make, less the holes of the pins: what is poured.
  Vec3 block = Vec3::Zero();
  double material = 0;
  for (const char* half : {"upper", "lower"}) {
    const TriangleMesh mesh = read_mesh(file(fmt::format("part-interior-mould-{}.stl", half)));
    EXPECT_EQ(shells(mesh).size(), 1u) << half;
    EXPECT_TRUE(self_intersections(mesh).empty()) << half;
    const Vec3 size = bounding_box(mesh).extent();
    EXPECT_EQ(bounding_box(mesh).lo[2], 0) << half;
    block = {size[0], size[1], block[2] + size[2]};
    material += reference::mesh_moments(mesh).value[S1];
  }
  const double hole =
      2 * 3 * 12 * std::sin(std::numbers::pi / 12) * 1.5 * 1.5;  // a prism of 24 sides, in both
  EXPECT_NEAR(block.prod() - material - 2 * hole, mould.at("metal_mm3").get<double>(), 1e-3 * casting);
}

TEST_F(Design, OfAnInfeasibleProblemWritesNothingAndSaysWhatWouldHelp) {
  const BenchAnswer a = design(fmt::format("spin ellipsoid --contact 12,19.5,0 -o {} --json {} {}",
                                           file("part.stl"), file("report.json"), "--resolution 24"));
  EXPECT_EQ(a.code, 3) << a.out;
  EXPECT_NE(a.out.find("would help"), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("other axes will do: the nearest"), std::string::npos) << a.out;
  EXPECT_FALSE(fs::exists(file("part.stl")));
  EXPECT_EQ(report().at("termination"), "infeasible");
  EXPECT_EQ(report().at("ok"), false);
}

TEST_F(Design, WhatDoesNotDoAsAskedIsWrittenAndEndsWithCodeFive) {
  // A post that stands in water is top-heavy, whatever its interior; and longer along its axis than across.
  write_mesh(file("post.off"), {box_mesh({0, 0, 0}, {20, 20, 60})});
  for (const std::string problem : {"float", "spin"}) {
    const std::string asked =
        fmt::format("{} {} -o {} --json {} --html {} --force --resolution 32 --wall 2.4mm", problem,
                    file("post.off"), file("part.stl"), file("report.json"), file("page.html"));
    const bool page = fs::exists("/usr/share/javascript/three/three.min.js");
    const std::string arguments =
        page ? asked : asked.substr(0, asked.find("--html")) + "--force --resolution 32 --wall 2.4mm";
    const BenchAnswer a = design(arguments);
    EXPECT_EQ(a.code, 5) << a.out;
    EXPECT_NE(a.out.find("does not " + problem), std::string::npos) << a.out;
    EXPECT_TRUE(fs::exists(file("part.stl")));
    EXPECT_EQ(fs::exists(file("page.html")), page);
    EXPECT_EQ(report().at("ok"), false);
    EXPECT_EQ(report().at("termination"), "optimal");
    EXPECT_EQ(design(arguments + " --accept").code, 0);
    EXPECT_EQ(report().at("ok"), false) << "accepted, and still so";
  }
}

TEST_F(Design, AFileTooSmallOrLargeToBeInMillimetresIsAskedForItsUnit) {
  for (const double size : {0.06, 60'000.0}) {
    const std::string name = file("part.off");
    write_mesh(name, {box_mesh({0, 0, 0}, {size, size, size / 2})});
    const std::string arguments =
        fmt::format("spin {} -o {} --force --resolution 24 --wall 4%", name, file("part.stl"));
    const BenchAnswer a = design(arguments);
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find(size < 1 ? "--unit mm (0.06 mm), cm (0.6 mm), m (60 mm), in (1.524 mm), or --size"
                                  : "--unit mm (6e+04 mm)"),
              std::string::npos)
        << a.out;
    EXPECT_EQ(std::ranges::count(a.out, '\n'), 1) << a.out;
    EXPECT_FALSE(fs::exists(file("part.stl")));
    EXPECT_EQ(design(arguments + " --size 60").code, 0);
    fs::remove(file("part.stl"));
  }
}

TEST_F(Design, TheUnitIsAskedForBeforeAnythingElseIsJudged) {
  // Of a body of 0.06 mm each of these is wrong: too thick, too fine, out of reach, or nothing to stand on.
  write_mesh(file("part.off"), {box_mesh({0, 0, 0}, {0.06, 0.06, 0.03})});
  for (const std::string options :
       {"spin --wall 1.2mm", "spin --wall 1.2mm --resolution 2", "spin --contact 5,5,5", "spin --axis auto",
        "spin --stem 30", "spin --cut 0,0,1,9 --pegs 2", "spin --mould", "spin --pegs 2", "yoyo --axle 3",
        "stand --up 1,1,1", "stand --up auto --wall 1.2mm", "stand --flatten 2", "stand --drain 3",
        "float --draft 30", "float --draft auto", "float --load 20@0,0,5", "balance --point 9,9,9",
        "hang --point 9,9,9"}) {
    const BenchAnswer a = design(fmt::format("{} {} -o {}", options, file("part.off"), file("part.stl")));
    EXPECT_EQ(a.code, 2) << options << '\n' << a.out;
    EXPECT_NE(a.out.find("does not say in what unit"), std::string::npos) << options << '\n' << a.out;
    EXPECT_EQ(std::ranges::count(a.out, '\n'), 1) << options << '\n' << a.out;
    EXPECT_FALSE(fs::exists(file("part.stl"))) << options;
  }
}

TEST_F(Design, DoesNotWriteOverAFileUnasked) {
  folder_.write("part.stl", "mine");
  const BenchAnswer a = design(fmt::format("spin ellipsoid -o {} --resolution 24", file("part.stl")));
  EXPECT_EQ(a.code, 2) << a.out;
  EXPECT_NE(a.out.find("exists; expected a new name, or --force"), std::string::npos) << a.out;
  EXPECT_EQ(fs::file_size(file("part.stl")), 4u);
}

TEST_F(Design, InterruptedLeavesNothing) {
  const BenchAnswer a = design(fmt::format("spin ellipsoid -o {} --resolution 512", file("part.stl")),
                               "timeout --preserve-status -s INT 1");
  EXPECT_EQ(a.code, 130) << a.out;
  EXPECT_EQ(files(), 0u);
}

struct Mistake {
  const char *arguments, *says;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.arguments; }

class DesignMistake : public ::testing::TestWithParam<Mistake> {};

TEST_P(DesignMistake, GetsOneLineAndExitCodeTwo) {
  const TemporaryFolder folder;
  const BenchAnswer a = design(GetParam().arguments, fmt::format("cd '{}';", folder.path.string()));
  EXPECT_EQ(a.code, 2) << a.out;
  EXPECT_EQ(std::ranges::count(a.out, '\n'), 1) << a.out;
  EXPECT_EQ(a.out.find("design: "), 0u) << a.out;
  EXPECT_NE(a.out.find(GetParam().says), std::string::npos) << a.out;
  EXPECT_TRUE(fs::is_empty(folder.path));
}

INSTANTIATE_TEST_SUITE_P(
    All, DesignMistake,
    ::testing::Values(
        Mistake{"spin ellipsoid", "--output is required"}, Mistake{"spin -o part.stl", "model is required"},
        Mistake{"sppin ellipsoid -o part.stl", "did you mean 'spin'?"},
        Mistake{"spin nosuch.stl -o part.stl", "no such file"},
        Mistake{"spin elipsoid -o part.stl", "did you mean 'ellipsoid'?"},
        Mistake{"spin ellipsoid -o part.xyz", "expected"},
        Mistake{"spin ellipsoid -o no/such/part.stl", "expected an existing folder"},
        Mistake{"spin ellipsoid -o /proc/part.stl", "folder /proc: "},
        Mistake{"spin ellipsoid -o part.stl --json /proc/report.json", "folder /proc: "},
        Mistake{"spin ellipsoid -o part.stl --wall 40%", "leaves no interior"},
        Mistake{"spin ellipsoid -o part.stl --wall 0.2 --resolution 200",
                "thinner than the printer's accuracy"},
        Mistake{"spin ellipsoid -o part.stl --wall 50%", "leaves no interior"},
        Mistake{"yoyo cuboid -o part.stl --wall 14.99 --resolution 48", "too small to be meshed in cells of"},
        Mistake{"spin ellipsoid -o part.stl --cut 1,2", "expected auto, or a plane"},
        Mistake{"spin ellipsoid -o part.stl --cut 0,0,1,900 --resolution 24", "misses the part"},
        Mistake{"spin ellipsoid -o part.stl --mould", "a denser interior (--interior-density)"},
        Mistake{"spin ellipsoid -o part.stl --mould --density 2 --interior-density 1",
                "whose shell is its densest material"},
        Mistake{"stand kitten -o part.stl --axle 3", "'--axle' was not expected"}));

}  // namespace THIS_FILE
}  // namespace kreisel::core
