// mistakes_test.cpp - what users get wrong: options, meshes, experiments. One clear line, nothing written.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "apps/run_bench.hpp"
#include "mesh/io/write.hpp"
#include "mesh/shapes.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

void expect_one_line(const BenchAnswer& a, const std::string& says) {
  EXPECT_EQ(a.code, 2) << a.out;
  EXPECT_EQ(std::ranges::count(a.out, '\n'), 1) << a.out;
  EXPECT_EQ(a.out.find("bench: "), 0u) << a.out;
  EXPECT_NE(a.out.find(says), std::string::npos) << a.out;
}

struct Mistake {
  const char* arguments;
  const char* says;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.arguments; }

class BenchMistake : public ::testing::TestWithParam<Mistake> {};

TEST_P(BenchMistake, GetsOneLineAndExitCodeTwo) {
  expect_one_line(bench(GetParam().arguments), GetParam().says);
}

INSTANTIATE_TEST_SUITE_P(
    All, BenchMistake,
    ::testing::Values(
        Mistake{"--model nosuch", "neither a known name nor a file"},
        Mistake{"--model dukc", "did you mean 'duck'?"}, Mistake{"--model /no/such.stl", "no such file"},
        Mistake{"--resolution 3000", "expected 2 to 1024"},
        Mistake{"--resolution abc", "cells along the longest side"},
        Mistake{"--wall 0.5h", "expected at least 0.87"}, Mistake{"--wall 50%", "leaves no interior"},
        Mistake{"--wall x", "expected a positive number"},
        Mistake{"--set foo=1", "expected GROUP.NAME=VALUE"},
        Mistake{"--set ipopt.nosuch=1", "ipopt has no setting of that name"},
        Mistake{"--set ipopt.tol=abc", "is not a value Ipopt takes"},
        Mistake{"--resolution 16 --set ipopt.linear_solver=ma57",
                "ipopt.linear_solver = ma57 is not installed; expected arrow or mumps"},
        Mistake{"--resolution 16 --set solver.defaults=ipopt --set ipopt.linear_solver=pardiso",
                "ipopt.linear_solver = pardiso is not installed"},
        Mistake{"--resolution 16 --set ipopt.output_file=/no/such/folder/log",
                "ipopt.output_file = /no/such/folder/log cannot be written"},
        Mistake{"--resolution 16 --set ipopt.option_file_name=my.opt",
                "ipopt.option_file_name = my.opt is not read; expected each option as ipopt.NAME"},
        Mistake{"--solver slsqp --formulation octree --level 3",
                "expected as many cells at least: a higher --level"},
        Mistake{"--set solver.start=nowhere", "expected lower, middle or upper"},
        Mistake{"--set problem.lambda=-1", "problem.lambda = '-1'; expected a number >= 0"},
        Mistake{"--formulation nosuch", "expected one of"},
        Mistake{"--problem nosuch", "expected one of: spin, top, yoyo, stand, float, balance, hang, die"},
        Mistake{"--problem float --set problem.draft=abc",
                "problem.draft = 'abc'; expected a share of the height"},
        Mistake{"--problem float --density 3 --set problem.draft=solid", "sinks"},
        Mistake{"--problem stand --set problem.target=foo",
                "problem.target = 'foo'; expected centre, inside or max-tilt"},
        Mistake{"--problem balance --axis auto", "expected a direction, for balance is asked in one pose"},
        Mistake{"--problem stand --up rest:0", "expected a whole number >= 1"},
        Mistake{"--problem stand --model cuboid --up rest:9", "comes to rest in 6 ways; expected 1 to 6"},
        Mistake{"--axis rest:1", "expected x,y,z, auto or near:x,y,z"},
        Mistake{"--axis near:0,0,0", "a direction other than zero"},
        Mistake{"--up around", "expected x,y,z, auto, near:x,y,z or rest:N"},
        Mistake{"--stem 0", "--stem 0 mm; expected > 0"}, Mistake{"--tip 1,2,3", "a radius and a height R,H"},
        Mistake{"--stem 1 --tip 2", "expected a tip that is no wider"},
        Mistake{"--problem float --stem 1", "--stem or --tip for a problem that does not spin on a point"},
        Mistake{"--problem stand --model kitten --flatten 80",
                "--flatten 80 mm of a body that is 59.99 mm high"},
        Mistake{"--problem stand --model ellipsoid --set problem.base=0%", "has no base to stand on: 1 of"},
        Mistake{"--problem balance", "expected --set problem.point=x,y,z"},
        Mistake{"--problem balance --set problem.point=1,2", "problem.point = '1,2'; expected three numbers"},
        Mistake{"--solver nosuch", "expected one of: ipopt"}, Mistake{"--axis 0,0,0", "no direction"},
        Mistake{"--axis 1,2", "expected x,y,z, auto or near:x,y,z"}, Mistake{"--density 0", "expected > 0"},
        Mistake{"--unit ccm", "unit 'ccm' is unknown (did you mean 'cm'?); expected one of: mm, cm, m, in"},
        Mistake{"--unit inch", "unit 'inch' is unknown; expected one of: mm, cm, m, in"},
        Mistake{"--model kitten --unit cm",
                "unit cm for model 'kitten'; expected none with the name of a model"},
        Mistake{"inspect bunny --unit in",
                "unit in for model 'bunny'; expected none with the name of a model"},
        Mistake{"--weld -1", "weld = '-1'; expected 0 mm or more"},
        Mistake{"inspect bunny --weld 0.1",
                "weld 0.1 mm for model 'bunny'; expected none with the name of a model"},
        Mistake{"--model part.3mf --unit in",
                "unit in for model 'part.3mf'; expected none with a file that says what its lengths are in"},
        Mistake{"--size -3", "expected > 0"}, Mistake{"--device nosuch", "'nosuch' not found; expected"},
        Mistake{"--nosuch", "not expected"}, Mistake{"--repeat 0", "expected a whole number >= 1"},
        Mistake{"--mesh /no/such/folder/a.stl", "expected an existing folder"},
        Mistake{"--mesh part.step", "expected .stl, .3mf, .obj, .ply or .off"},
        Mistake{"--json /no/such/folder/a.json", "expected an existing folder"},
        Mistake{"run nosuch", "nosuch"},
        // One each of what is listed as a mistake that users make.
        Mistake{"--model elipsoid", "did you mean 'ellipsoid'?"},
        Mistake{"inspect elipsoid", "did you mean 'ellipsoid'?"}, Mistake{"inspect", "model is required"},
        Mistake{"--model /", "expected"},
        Mistake{"--resolution 0", "expected cells along the longest side (2 to 1024)"},
        Mistake{"--resolution 1", "expected cells along the longest side (2 to 1024)"},
        Mistake{"--resolution -5", "expected cells along the longest side (2 to 1024)"},
        Mistake{"--resolution 12x12", "or NXxNYxNZ"},
        Mistake{"--resolution 100000", "would need 522 GiB); expected 2 to 1024"},
        Mistake{"--formulation octree --level 0", "level = '0'; expected 1 to 10"},
        Mistake{"--formulation octree --level -3", "level = '-3'; expected 1 to 10"},
        Mistake{"--formulation octree --level 13", "GiB); expected 2 to 1024"},
        Mistake{"--formulation octree --set formulation.gamma_l=-1",
                "formulation.gamma_l = '-1'; expected a number >= 0"},
        Mistake{"--formulation octree --set formulation.epsilon=0.7", "expected a number between 0 and 0.5"},
        Mistake{"--problem top --set problem.gamma_c=-1", "problem.gamma_c = '-1'; expected a number >= 0"},
        Mistake{"--problem yoyo --model cuboid --set problem.gamma_i=-1",
                "problem.gamma_i = '-1'; expected a number > 0"},
        Mistake{"--problem top --formulation octree --contact 200,0,0", "through it misses the body"},
        Mistake{"--problem yoyo --model cuboid --contact 500,0,0", "expected"},
        Mistake{"--up 0,0,0", "--up 0,0,0 has no direction"},
        Mistake{"--contact 500,0,0", "contact 500,0,0 lies off the axis"},
        Mistake{"--contact nan,0,0", "expected three numbers"},
        Mistake{"--density -1", "density -1 g/cm^3; expected > 0"},
        Mistake{"--density nan", "density = 'nan'; expected a number"},
        Mistake{"--density 1 --void-density 1",
                "void density 1 g/cm^3 in an interior of 1; expected another"},
        Mistake{"--interior-density 8.1 --void-density 8.1", "void density 8.1 g/cm^3 in an interior of 8.1"},
        Mistake{"--interior-density 0", "interior density 0 g/cm^3; expected > 0"},
        Mistake{"--interior-density -8", "interior density -8 g/cm^3; expected > 0"},
        Mistake{"--void-density -1", "void density -1 g/cm^3; expected 0 or more"},
        Mistake{"--solver plane-sweep --formulation voxel", "solver 'plane-sweep' does not solve 'spin'"},
        Mistake{"--solver plane-sweep --problem stand", "does not work with formulation 'rayrep'"},
        Mistake{"--solver plane-sweep --formulation voxel --problem stand --target max-tilt --model kitten "
                "--resolution 16",
                "solver 'plane-sweep' for stand as it is set; expected the problem stand with target"},
        Mistake{"--precision singel", "expected automatic or single"},
        Mistake{"--rounding fited", "expected nearest or fitted"},
        Mistake{"--wall -1", "expected a positive number"},
        Mistake{"--formulation ray-rep", "(did you mean 'rayrep'?)"},
        Mistake{"--problem flaot", "(did you mean 'float'?)"},
        Mistake{"--solver ipotp", "(did you mean 'ipopt'?)"},
        Mistake{"--formulaton voxel", "'--formulaton' was not expected (did you mean '--formulation'?)"},
        Mistake{"--formulaton=voxel", "(did you mean '--formulation'?)"},
        Mistake{"devcies", "'devcies' was not expected (did you mean 'devices'?)"},
        Mistake{"run rayrep_tabel2", "(did you mean 'rayrep_table2'?)"},
        Mistake{"--set problm.lambda=1", "group 'problm' is unknown (did you mean 'problem'?)"},
        Mistake{"--set problem.lamda=1",
                "problem.lamda = 1; spin has no setting of that name (did you mean lambda?)"},
        Mistake{"--set ipopt.max_itr=1", "(did you mean max_iter?)"},
        Mistake{"--json /proc/a.json --resolution 16 --fineness 8", "folder /proc: No such file"},
        Mistake{"--mesh /proc/a.stl --resolution 16 --fineness 8", "folder /proc: No such file"},
        Mistake{"--record /proc/a.h5 --resolution 16 --fineness 8", "folder /proc: No such file"},
        Mistake{"run rayrep_bird --results /proc/no", "/proc/no/rayrep_bird: No such file"},
        Mistake{"run rayrep_bird --csv /no/a.csv", "--csv /no/a.csv; expected an existing folder"},
        Mistake{"report rayrep_bird -o /no/a.html", "-o /no/a.html; expected an existing folder"},
        Mistake{"list > /dev/full", "standard output: No space left on device"},
        Mistake{"show /no/such.h5", "no such file"}));

/// A mesh file that is none, or none of a solid.
struct BadMesh {
  const char* file;
  std::string (*bytes)();  ///< of the file; null: there is none
  const char* says;
};

void PrintTo(const BadMesh& mesh, std::ostream* out) { *out << mesh.file; }

std::string off(const TriangleMesh& mesh) {
  const TemporaryFolder folder;
  write_mesh(folder.path / "mesh.off", {mesh});
  std::ifstream in(folder.path / "mesh.off", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TriangleMesh cube(double lo, double hi) { return box_mesh({lo, lo, lo}, {hi, hi, hi}); }

/// Binary STL of as many facets as it says, all of them the same.
std::string stl(std::uint32_t says, std::uint32_t holds, float x) {
  std::string bytes(80, ' ');
  bytes.append(reinterpret_cast<const char*>(&says), 4);
  const float facet[12] = {0, 0, 1, x, 0, 0, 1, 0, 0, 0, 1, 0};
  for (std::uint32_t i = 0; i < holds; ++i)
    bytes.append(reinterpret_cast<const char*>(facet), sizeof facet).append(2, '\0');
  return bytes;
}

class BenchMesh : public ::testing::TestWithParam<BadMesh> {
 protected:
  const TemporaryFolder folder_;
};

TEST_P(BenchMesh, IsRefusedInOneLineAndNothingIsWritten) {
  const BadMesh& bad = GetParam();
  const fs::path model = folder_.path / bad.file;
  if (bad.bytes) std::ofstream(model, std::ios::binary) << bad.bytes();
  const std::string at = folder_.path.string();
  const BenchAnswer a =
      bench(fmt::format("--model {} --resolution 12 --json {}/a.json --mesh {}/a.stl --record {}/a.h5",
                        model.string(), at, at, at));
  expect_one_line(a, bad.says);
  EXPECT_NE(a.out.find(bad.file), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("expected"), std::string::npos) << a.out;
  const auto files = std::distance(fs::directory_iterator(folder_.path), fs::directory_iterator{});
  EXPECT_EQ(files, bad.bytes ? 1 : 0);
}

INSTANTIATE_TEST_SUITE_P(
    All, BenchMesh,
    ::testing::Values(
        BadMesh{"missing.stl", nullptr, "no such file"},
        BadMesh{"empty.stl", [] { return std::string(); }, "empty file"},
        BadMesh{"cut.stl", [] { return stl(12, 2, 0); }, "binary STL of 184 bytes, expected 684"},
        BadMesh{"cut.off", [] { return std::string("OFF\n8 12 0\n0 0 0\n4 0 0\n"); },
                "ends after 2 vertices, expected 8"},
        BadMesh{"text.stl", [] { return std::string("solid words\nthat are no mesh\n"); },
                "line 2: 'that', expected a word of text STL"},
        BadMesh{"claim.stl", [] { return std::string("Believe me, this is STL.\n"); },
                "binary STL of 25 bytes"},
        BadMesh{"nan.stl", [] { return stl(1, 1, NAN); }, "vertex 1 of facet 1 is (nan, 0, 0)"},
        BadMesh{"infinite.stl", [] { return stl(1, 1, INFINITY); }, "vertex 1 of facet 1 is (inf, 0, 0)"},
        BadMesh{"open.off",
                [] {
                  TriangleMesh mesh = cube(0, 4);
                  mesh.triangles.pop_back();
                  return off(mesh);
                },
                "open edges: 3, the first from"},
        BadMesh{"fin.off",
                [] {
                  TriangleMesh mesh = cube(0, 4);
                  mesh.vertices.emplace_back(8, 8, 2);
                  mesh.triangles.push_back({0, 1, 8});
                  return off(mesh);
                },
                "edges of more than two triangles: 1, the first from"},
        BadMesh{"inside_out.off", [] { return off(both(cube(0, 4), inverted(cube(2, 6)))); },
                "mm^3 are enclosed inside out, at"},
        BadMesh{"pieces.off", [] { return off(both(cube(0, 4), cube(5, 7))); },
                "2 pieces that do not touch, no rigid body"}));

class BenchExperiment : public ::testing::Test {
 protected:
  [[nodiscard]] BenchAnswer run(const std::string& toml) const {
    const fs::path file = folder_.write("trial.toml", toml);
    return bench(fmt::format("run {} --results {}", file.string(), (folder_.path / "runs").string()));
  }
  void refuses(const std::string& toml, const std::string& where, const std::string& says) const {
    const BenchAnswer a = run(toml);
    expect_one_line(a, says);
    EXPECT_NE(a.out.find(where), std::string::npos) << a.out;
    EXPECT_FALSE(fs::exists(folder_.path / "runs")) << "nothing has run";
  }
  const TemporaryFolder folder_;
};

TEST_F(BenchExperiment, ThatIsNoTomlSaysFileLineAndWhat) {
  refuses("[[run]]\nmodel = \"ellipsoid\n", "trial.toml: line 2: ", "expected TOML");
  refuses("# a name that is none\n[[run]]\n[ = ]\n", "trial.toml: line 3: no name of a table or key",
          "expected TOML");
  refuses("model =\n[[run]]\n", "trial.toml: line 1: ", "expected value");
  refuses("", "trial.toml: line 1: ", "expected at least one [[run]]");
}

TEST_F(BenchExperiment, WithUnknownKeysSaysTheNearest) {
  refuses("modle = \"bird\"\n[[run]]\n", "line 1: ", "key 'modle' is unknown (did you mean 'model'?)");
  refuses("tabel = \"settings\"\n[[run]]\n", "line 1: ", "(did you mean 'table'?)");
  refuses("[[run]]\n\nlabell = \"x\"\n", "line 3: ", "(did you mean 'label'?)");
  refuses("[[runs]]\nmodel = \"bird\"\n", "line 1: ", "key 'runs' is unknown (did you mean 'run'?)");
  refuses("[[run]]\nset.problm.lambda = 1\n", "line 2: ", "(did you mean 'problem'?)");
}

TEST_F(BenchExperiment, WithASettingOfAProblemAmongTheKeysSaysWhereItBelongs) {
  refuses("problem = \"stand\"\ntarget = \"inside\"\n[[run]]\n",
          "line 2: ", "setting 'target' outside 'set', expected set.problem.target");
  refuses("[[run]]\nfluid-density = 1.1\n", "line 2: ", "expected set.problem.fluid_density");
}

TEST_F(BenchExperiment, WithUnknownNamesSaysTheNearestBeforeAnythingRuns) {
  const std::string runs = "[[run]]\nresolution = 16\nfineness = 8\n[[run]]\n";
  refuses(runs + "problem = \"spni\"", "line 5: ", "problem 'spni' is unknown (did you mean 'spin'?)");
  refuses(runs + "formulation = [\"rayrep\",\n\"voxl\"]", "line 6: ", "(did you mean 'voxel'?)");
  refuses(runs + "solver = \"ipotp\"", "line 5: ", "(did you mean 'ipopt'?)");
  refuses(runs + "model = \"elipsoid\"", "experiment trial: ", "did you mean 'ellipsoid'?");
  refuses("table = \"setings\"\n" + runs, "line 1: ", "(did you mean 'settings'?)");
  refuses("figures = [\"hisory\"]\n" + runs, "experiment trial: ", "(did you mean 'history'?)");
  refuses("published = \"rayrep_tabel1\"\n" + runs, "experiment trial: ", "(did you mean 'rayrep_table1'?)");
}

TEST_F(BenchExperiment, WithUnfitValuesSaysTheLine) {
  refuses("[[run]]\nresolution = [16, 0]\n", "line 2: ", "resolution = '0'; expected cells");
  refuses("[[run]]\nunit = [\"mm\", \"km\"]\n", "line 2: ", "unit 'km' is unknown (did you mean 'mm'?)");
  refuses("[[run]]\nunit = \"cm\"\n", "experiment trial: ", "unit cm for model 'ellipsoid'; expected none");
  refuses("[[run]]\naxis = [0, 0, 1]\n", "line 2: ", "expected x,y,z, auto or near:x,y,z");
}

TEST_F(BenchExperiment, IntoAFileInsteadOfAFolderIsRefused) {
  const fs::path file = folder_.write("plain", "no folder");
  const fs::path toml = folder_.write("trial.toml", "[[run]]\nresolution = 16\nfineness = 8\n");
  expect_one_line(bench(fmt::format("run {} --results {}", toml.string(), file.string())),
                  "plain/trial: Not a directory, expected a folder for results");
}

TEST(BenchMistakes, WhatComesToNothingOfAFileWithoutAUnitAsksForIt) {
  const TemporaryFolder folder;
  const std::string name = (folder.path / "part.off").string();
  write_mesh(name, {box_mesh({0, 0, 0}, {0.06, 0.06, 0.03})});
  for (const std::string command : {"--wall 1.2", "map --axes 20 --wall 1.2", "simulate --contact 5,5,5"}) {
    const std::size_t words = command.starts_with("--") ? 0 : command.find(' ');
    expect_one_line(bench(command.substr(0, words) + " --model " + name + " " + command.substr(words)),
                    "does not say in what unit; expected --unit mm (0.06 mm), cm (0.6 mm), m (60 mm)");
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
