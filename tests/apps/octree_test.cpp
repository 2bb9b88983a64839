// octree_test.cpp - octrees as a user runs them: problems, materials, what rounds to infeasible, what cannot
// be.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/run_bench.hpp"
#include "body/test_meshes.hpp"
#include "mesh/io/write.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using nlohmann::json;

class OctreeRun : public testing::Test {
 protected:
  [[nodiscard]] BenchAnswer octree(const std::string& more) const {
    return bench(fmt::format("--formulation octree --json '{}' {}", at("run.json"), more));
  }
  [[nodiscard]] json result() const {
    std::ifstream in(at("run.json"));
    return json::parse(in, nullptr, false);
  }
  [[nodiscard]] std::string at(const char* file) const { return (folder_.path / file).string(); }
  void write_box(const char* file, const Vec3& size) const {
    write_mesh(folder_.path / file, {box_mesh(Vec3::Zero(), size)});
  }

  const TemporaryFolder folder_;
};

/// Within a hundredth of the certified bound, to the written part, in every problem and way to solve.
TEST_F(OctreeRun, SolvesTopsYoyosAndTwoMaterials) {
  for (const char* const task :
       {"--problem top --level 5", "--problem top --set problem.form=angle --level 5",
        "--problem top --level 5 --set ipopt.hessian_approximation=limited-memory",
        "--problem yoyo --model cuboid --axis 0.1,0,1 --axle 3 --level 5",
        "--problem top --level 5 --interior-density 8.1",
        "--problem top --level 5 --interior-density 0.5 --void-density 8.1"}) {
    const BenchAnswer a = octree(fmt::format("{} --certify", task));
    EXPECT_EQ(a.code, 0) << task << a.out;
    const json r = result();
    EXPECT_TRUE(r.at("verified").at("ok").get<bool>()) << task << a.out;
    EXPECT_LE(r.at("gap").get<double>(), 0.01) << task;
    EXPECT_GE(r.at("refinements").size(), 3u) << "levels 2 to 5" << task;
    EXPECT_LE(r.at("rounding").at("constraint_violation").get<double>(), 1e-3) << task;
  }
}

TEST_F(OctreeRun, ThatRoundsToInfeasibleSaysByHowMuchAndIsMended) {
  const BenchAnswer nearest = octree("--level 5 --rounding nearest");
  const double missed = result().at("rounding").at("constraint_violation").get<double>();
  EXPECT_EQ(result().at("rounding").at("moved_voxels"), 0);
  EXPECT_NE(nearest.out.find(fmt::format("violation {:.1e}", missed)), std::string::npos) << nearest.out;
  EXPECT_GT(missed, 5e-5);
  EXPECT_LE(result().at("constraint_violation").get<double>(), 1e-8) << "it was feasible before";
  const BenchAnswer fitted = octree("--level 5");
  EXPECT_EQ(fitted.code, 0) << fitted.out;
  EXPECT_GT(result().at("rounding").at("moved_voxels").get<int>(), 0);
  EXPECT_LT(result().at("rounding").at("constraint_violation").get<double>(), missed / 5);
  EXPECT_TRUE(result().at("verified").at("ok").get<bool>()) << fitted.out;
}

/// The bird's 33 cells of the first round cannot meet the constraints, as finer ones can.
TEST_F(OctreeRun, WhoseFirstCellsAreTooCoarseIsRefinedUntilTheyAreNot) {
  const BenchAnswer a = octree("--level 5 --model bird --certify");
  EXPECT_EQ(a.code, 0) << a.out;
  const json r = result();
  EXPECT_EQ(r.at("termination"), "optimal");
  EXPECT_GT(r.at("refinements").at(0).at("constraint_violation").get<double>(), 1e-4)
      << "or nothing was tested";
  EXPECT_LE(r.at("gap").get<double>(), 0.01) << a.out;
  EXPECT_TRUE(r.at("verified").at("ok").get<bool>()) << a.out;
}

TEST_F(OctreeRun, OfAShapeThinnerThanTwoWallsIsRefused) {
  write_box("plate.off", {40, 40, 2});
  for (const char* const formulation : {"octree", "quadric"}) {
    const BenchAnswer a = bench(
        fmt::format("--formulation {} --model '{}' --level 6 --wall 1.1", formulation, at("plate.off")));
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find("leaves no interior"), std::string::npos) << a.out;
  }
}

/// The axis runs beside the middle by more than what any void makes up for; octree and certificate agree.
TEST_F(OctreeRun, OfAnAxisThatCannotBeBalancedIsInfeasibleWithAProof) {
  write_box("box.off", {40, 40, 30});
  const BenchAnswer a =
      octree(fmt::format("--model '{}' --problem top --contact 4,20,0 --level 5 --certify", at("box.off")));
  EXPECT_EQ(a.code, 3) << a.out;
  EXPECT_EQ(result().at("termination"), "infeasible") << a.out;
  EXPECT_EQ(result().at("certificate"), "infeasible") << a.out;
  EXPECT_NE(a.out.find("infeasible the centre of mass stays "), std::string::npos) << a.out;
}

TEST_F(OctreeRun, BySlsqpIsThatOfIpopt) {
  const std::string task = "--model heart --level 4 --solver";
  const BenchAnswer a = octree(task + " slsqp");
  EXPECT_EQ(a.code, 0) << a.out;
  EXPECT_EQ(result().at("solver"), "slsqp");
  const double found = result().at("objective").get<double>();
  EXPECT_EQ(octree(task + " ipopt").code, 0);
  EXPECT_NEAR(found, result().at("objective").get<double>(), 1e-5 * found);
}

TEST_F(OctreeRun, BySlsqpStopsOnCtrlCWithinAnIteration) {
  // 1464 cells, of which NLopt's first iteration takes half a minute.
  const auto begin = std::chrono::steady_clock::now();
  const BenchAnswer stopped = shell(
      interrupted_when(fmt::format("--formulation octree --model heart --level 5 --wall 4h --solver slsqp "
                                   "--set formulation.start_level=5 --json '{}'",
                                   at("run.json")),
                       "sleep 4"));
  EXPECT_EQ(stopped.code, 130) << stopped.out;
  EXPECT_EQ(stopped.out, "bench: interrupted, nothing written\n");
  EXPECT_FALSE(std::filesystem::exists(at("run.json")));
  // A twentieth of a second, on a machine that does nothing else.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(4 + 6));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
