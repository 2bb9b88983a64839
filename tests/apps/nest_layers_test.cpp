// nest_layers_test.cpp - layers, landscapes and their pictures as a user makes them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/run_bench.hpp"
#include "body/test_meshes.hpp"
#include "mesh/io/write.hpp"
#include "places.hpp"
#include "record/records_in.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class BenchLayers : public testing::Test {
 protected:
  BenchLayers() { write_mesh(folder_.path / "cube.off", {box_mesh({0, 0, 0}, {4, 4, 4})}); }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path / name).string(); }
  [[nodiscard]] BenchAnswer nest(const std::string& more) const {
    return bench(fmt::format("nest --outer '{}' {}", file("cube.off"), more));
  }
  [[nodiscard]] bool draws(const std::string& script, const std::string& record) const {
    const BenchAnswer a = shell(fmt::format("/usr/bin/python3 '{}/plots/{}.py' '{}' -o '{}'", source_folder,
                                            script, file(record), file("picture.png")));
    EXPECT_EQ(a.code, 0) << a.out;
    return std::filesystem::exists(file("picture.png")) && std::filesystem::remove(file("picture.png"));
  }
  const TemporaryFolder folder_;
};

TEST_F(BenchLayers, PutsAShapeIntoItselfWithWallsAndKeepsIt) {
  const BenchAnswer a = nest(fmt::format(
      "--outer-size 40 --layers 2 --printer-accuracy 0.5 --wall 1.5 --cells 32 --free "
      "position,centroid-plane "
      "--particles 8 --iterations 3 --climb-iterations 15 --keep-shapes yes --json - --record '{}'",
      file("layers.h5")));
  ASSERT_EQ(a.code, 0) << a.out;
  const auto j = nlohmann::json::parse(a.out);
  ASSERT_EQ(j.at("layers").size(), 2u);
  EXPECT_EQ(j.at("termination"), "valid");
  const double first = j.at("layers").at(0).at("longest_mm");
  EXPECT_LT(first, 36) << "of 40, and 2 on either side";
  EXPECT_GT(first, 30);
  for (const auto& layer : j.at("layers")) EXPECT_GE(layer.at("thickness_mm").get<double>(), 1.5);
  EXPECT_NEAR(j.at("scale").get<double>(), first / 40, 1e-12);
  EXPECT_EQ(kind_of_record(file("layers.h5")), RecordKind::nesting);
  nlohmann::json read = read_record(file("layers.h5")).summary.whole(), told = j;
  for (nlohmann::json* all : {&read, &told})
    for (auto& layer : all->at("layers")) layer.erase("plane");  // kept as a point and a normal: round-off
  EXPECT_EQ(read, told);
  EXPECT_TRUE(draws("nest_picture", "layers.h5"));
}

TEST_F(BenchLayers, MapsHowLargeOutlinesNestAndCertifiesTheBest) {
  const BenchAnswer a =
      nest(fmt::format("--landscape 4 --rotations 64 --json - --record '{}'", file("map.h5")));
  ASSERT_EQ(a.code, 0) << a.out;
  const auto j = nlohmann::json::parse(a.out);
  EXPECT_EQ(j.at("termination"), "complete");
  EXPECT_EQ(j.at("centroids"), nlohmann::json({4, 4}));
  EXPECT_EQ(j.at("inside"), 16);
  // The nearest centroids to the middle are an eighth of the side away in x and y.
  EXPECT_NEAR(j.at("scale").get<double>(), 0.75, 0.005);
  EXPECT_NEAR(j.at("certified_scale").get<double>(), j.at("scale").get<double>(), 0.005);
  EXPECT_EQ(read_record(file("map.h5")).summary.whole(), j);
  EXPECT_TRUE(draws("nest_landscape", "map.h5"));
}

TEST_F(BenchLayers, APagmoSearchTakesFilesWithSpacesAndLayers) {
  write_mesh(folder_.path / "a cube.off", {box_mesh({0, 0, 0}, {4, 4, 4})});
  std::ofstream(file("spaces.toml")) << fmt::format(
      "table = 'nestings'\nouter = '{}'\nfree = 'position,centroid-plane'\nswarm = 'pagmo-de'\nparticles = "
      "8\n"
      "iterations = 3\ncentroid = '-1,-1,-1'\n[[run]]\nlabel = 'one'\n",
      file("a cube.off"));
  std::ofstream(file("layers.toml")) << fmt::format(
      "table = 'nest-layers'\nouter = '{0}'\nwithin = '{1}'\nfree = 'position,centroid-plane'\n"
      "swarm = 'pagmo-de'\nparticles = 8\niterations = 3\nlayers = 2\n[[run]]\n",
      file("cube.off"), file("a\\ cube.off"));
  for (const char* name : {"spaces", "layers"}) {
    const BenchAnswer a =
        bench(fmt::format("run '{}' --results '{}'", file(name + std::string(".toml")), file("results")));
    EXPECT_EQ(a.code, 0) << a.out;
    EXPECT_NE(a.out.find("1 runs done, 0 finished before, 0 failed"), std::string::npos) << a.out;
  }
}

TEST_F(BenchLayers, RefusesWhatDoesNotGoTogetherInOneLine) {
  for (const auto& [arguments, says] :
       {std::pair{"--layers 2", "layers without free; expected"},
        std::pair{"--wall 1",
                  "wall: a search of the scale has no such field; expected a kind that has it: layers"},
        std::pair{"--free all --layers 2 --wall -1", "wall = '-1'; expected a number >= 0"},
        std::pair{
            "--landscape 4 --free all",
            "free: a landscape of outlines has no such field; expected a kind that has it: swarm, layers"},
        std::pair{"--landscape 4 --view 0,0,1", "silhouette seen along its up direction"},
        std::pair{"--keep-shapes maybe", "keep-shapes = 'maybe'; expected no or yes"}}) {
    const BenchAnswer a = nest(arguments);
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find(says), std::string::npos) << a.out;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
