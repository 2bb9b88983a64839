// project_test.cpp - a part with infill of its own, as slicers keep it: written, and read again.
#include "mesh/io/threemf/project.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "geometry/moved.hpp"
#include "mesh/io/read_3mf.hpp"
#include "mesh/io/threemf/package.hpp"
#include "mesh/shapes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using threemf::Dialect;

threemf::Project boxes() {
  threemf::Project project;
  project.name = "a & b";
  project.volumes = {{"full", box_mesh({0, 0, 0}, {10, 20, 30}), false, {{"a", "100%"}}},
                     {"sparse", box_mesh({2, 2, 2}, {8, 18, 28}), true, {{"b", "<"}}}};
  project.to_bed.linear() = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  project.to_bed.translation() = Vec3(125, 105, 3);
  return project;
}

class Projects : public ::testing::TestWithParam<Dialect> {};

TEST_P(Projects, ComeBackAsTheyLieOnTheBed) {
  const threemf::Project project = boxes();
  const std::string bytes = encode_project(project, GetParam(), "a.3mf");
  const auto read = threemf::read_project({"a.3mf", bytes});
  ASSERT_EQ(read.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].modifier, i == 1);
    const TriangleMesh laid = moved(project.volumes[i].mesh, project.to_bed);
    ASSERT_EQ(read[i].mesh.triangles.size(), laid.triangles.size());
    // Triangle by triangle: vertices may have other numbers.
    for (std::size_t t = 0; t < laid.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LT((read[i].mesh.vertices[read[i].mesh.triangles[t][k]] - laid.vertices[laid.triangles[t][k]])
                      .norm(),
                  1e-12);
  }
  // Who reads the shape alone gets the outer one: what is inside it is no material of its own.
  const auto objects = read_3mf_objects({"a.3mf", bytes});
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects.front().triangles.size(), 12u);
}

TEST_P(Projects, FarAwayKeepTheirDigits) {
  threemf::Project project = boxes();
  project.place = Vec3(1e6, -2e6, 5e5);
  for (threemf::Volume& volume : project.volumes)
    volume.mesh = moved(volume.mesh, Eigen::Translation3d(project.place));
  const auto read = threemf::read_project({"a.3mf", encode_project(project, GetParam(), "a.3mf")});
  const Vec3 corner = project.to_bed.inverse() * read.front().mesh.vertices.front();
  EXPECT_LT((corner - project.volumes.front().mesh.vertices.front()).norm(), 1e-8);
}

TEST_P(Projects, OfOneVolumeHaveNoModifier) {
  threemf::Project project = boxes();
  project.volumes.pop_back();
  const auto read = threemf::read_project({"a.3mf", encode_project(project, GetParam(), "a.3mf")});
  ASSERT_EQ(read.size(), 1u);
  EXPECT_FALSE(read.front().modifier);
}

TEST_P(Projects, SaySettingsWhereTheirSlicerLooksForThem) {
  const bool prusa = GetParam() == Dialect::prusa;
  const threemf::Package package = threemf::unpack({"a.3mf", encode_project(boxes(), GetParam(), "a.3mf")});
  const std::string& settings =
      package.at(prusa ? "metadata/slic3r_pe_model.config" : "metadata/model_settings.config");
  const std::vector<std::string> expected =
      prusa ? std::vector<std::string>{R"(<volume firstid="12" lastid="23">)",
                                       R"(key="volume_type" value="ParameterModifier")",
                                       R"(type="volume" key="a" value="100%")", R"(value="a &amp; b")"}
            : std::vector<std::string>{R"(<part id="2" subtype="modifier_part">)", R"(key="b" value="&lt;")",
                                       R"(<object id="3">)", R"(key="object_id" value="3")"};
  for (const std::string& text : expected) EXPECT_NE(settings.find(text), std::string::npos) << settings;
}

TEST(PrusaProjects, HoldTheProfile) {
  threemf::Project project = boxes();
  project.settings = {{"layer_height", "0.2"}, {"fill_density", "15%"}};
  const auto packed = [&](Dialect dialect) {
    return threemf::unpack({"a.3mf", encode_project(project, dialect, "a.3mf")});
  };
  EXPECT_EQ(packed(Dialect::prusa).at("metadata/slic3r_pe.config"),
            "; layer_height = 0.2\n; fill_density = 15%\n");
  EXPECT_FALSE(packed(Dialect::orca).contains("metadata/slic3r_pe.config"));
}

INSTANTIATE_TEST_SUITE_P(Dialects, Projects, ::testing::Values(Dialect::prusa, Dialect::orca));

}  // namespace THIS_FILE
}  // namespace kreisel::core
