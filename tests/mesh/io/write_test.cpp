#include "mesh/io/write.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <iterator>
#include <limits>

#include "body/models/geodesic.hpp"
#include "mesh/mesh_folder.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

class WriteMesh : public MeshFolder {
 protected:
  static std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  std::size_t files() const {
    return std::size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
  }
};

TriangleMesh tetrahedron(double x) {
  return {{{x, 0, 0}, {x + 2, 0, 0}, {x, 2, 0}, {x, 0, 2}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

TEST_F(WriteMesh, PutsStlHeaderCountAndOutwardUnitNormals) {
  write_mesh(folder_ / "a.stl", {tetrahedron(0)});
  const std::string bytes = bytes_of(folder_ / "a.stl");
  ASSERT_EQ(bytes.size(), 84u + 4 * 50);
  EXPECT_STREQ(bytes.c_str(), "kreisel binary STL, units mm");
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  EXPECT_EQ(count, 4u);
  const float third = 1 / std::sqrt(3.0f);
  const float want[4][3] = {{0, 0, -1}, {0, -1, 0}, {third, third, third}, {-1, 0, 0}};
  for (std::size_t f = 0; f < 4; ++f) {
    float normal[3];
    std::memcpy(normal, bytes.data() + 84 + 50 * f, 12);
    for (int k = 0; k < 3; ++k) EXPECT_FLOAT_EQ(normal[k], want[f][k]) << "facet " << f;
  }
}

TEST_F(WriteMesh, PutsAllPartsIntoOneFile) {
  write_mesh(folder_ / "a.stl", {tetrahedron(0), tetrahedron(10)});
  const TriangleMesh back = read_mesh(folder_ / "a.stl");
  EXPECT_EQ(back.vertices.size(), 8u);
  EXPECT_NO_THROW(require_solid(back, "two parts"));
  EXPECT_DOUBLE_EQ(inspect(back).volume, 2 * 8.0 / 6);
}

TEST_F(WriteMesh, KeepsObjectsApartWhereAFormatHasThem) {
  write_objects(folder_ / "a.3mf",
                {{"shell & <\"rim\">", {tetrahedron(0), tetrahedron(10)}}, {"interior", {tetrahedron(20)}}});
  const std::vector<TriangleMesh> objects = read_objects(folder_ / "a.3mf");
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].triangles.size(), 8u);
  EXPECT_EQ(objects[1].triangles.size(), 4u);
  EXPECT_EQ(objects[1].vertices[1], Vec3(22, 0, 0));
  EXPECT_EQ(read_mesh(folder_ / "a.3mf").triangles.size(), 12u);
  write_mesh(folder_ / "a.stl", {tetrahedron(0), tetrahedron(10)});
  EXPECT_EQ(read_objects(folder_ / "a.stl").size(), 1u);
}

TEST_F(WriteMesh, HoldsAnyPlaceInThreeMf) {
  for (const double away : {300.0, 123456.0, 987654321.0}) {
    const Vec3 place(away, -0.7 * away, 0);
    TriangleMesh mesh = geodesic_sphere(3);
    for (Vec3& v : mesh.vertices) v = 20 * v + place;
    write_mesh(folder_ / "a.3mf", {mesh});
    const TriangleMesh back = read_mesh(folder_ / "a.3mf");
    ASSERT_EQ(back.vertices.size(), mesh.vertices.size());
    // Floats of 300 where the origin is near; else of 60 about a place that is a float, and doubles of 1e9.
    const double rounding = away > 1e3 ? 2.1e-6 : 1.6e-5;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      EXPECT_LE((back.vertices[i] - mesh.vertices[i]).cwiseAbs().maxCoeff(), rounding) << away;
  }
}

TEST_F(WriteMesh, ReplacesAnEarlierFileAndLeavesNothingElse) {
  std::ofstream(folder_ / "a.stl") << "old";
  write_mesh(folder_ / "a.stl", {tetrahedron(0)});
  EXPECT_EQ(bytes_of(folder_ / "a.stl").size(), 284u);
  EXPECT_EQ(files(), 1u);
}

TEST_F(WriteMesh, MakesTheFolder) {
  write_mesh(folder_ / "new" / "a.off", {tetrahedron(0)});
  EXPECT_TRUE(fs::exists(folder_ / "new" / "a.off"));
}

TEST_F(WriteMesh, NamesAFolderThatCannotBe) {
  (void)file("taken", "a file");
  try {
    write_mesh(folder_ / "taken" / "a.stl", {tetrahedron(0)});
    FAIL() << "written";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find((folder_ / "taken").string()), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("folder"), std::string::npos) << e.what();
  }
}

TEST_F(WriteMesh, LeavesNothingBehindWhenItFails) {
  fs::create_directories(folder_ / "a.stl" / "in_the_way");  // the name is taken by a folder
  EXPECT_THROW(write_mesh(folder_ / "a.stl", {tetrahedron(0)}), InputError);
  EXPECT_EQ(files(), 1u);
  EXPECT_THROW(write_mesh(folder_ / "b.stl", {tetrahedron(1e39)}), InputError);  // beyond float
  EXPECT_THROW(write_mesh(folder_ / "b.3mf", {tetrahedron(1e10)}), InputError);  // beyond what 3MF may hold
  for (const char* name : {"b.stl", "b.3mf", "b.obj", "b.ply", "b.off"})
    EXPECT_THROW(write_mesh(folder_ / name, {tetrahedron(std::numeric_limits<double>::quiet_NaN())}),
                 InputError)
        << name;
  EXPECT_THROW(write_mesh(folder_ / "b.step", {tetrahedron(0)}), InputError);
  EXPECT_EQ(files(), 1u);
}

/// Extension, and by how much a coordinate of up to 1 may change on the way: half a float's unit in the last
/// place where the format holds floats. 3MF is text, cut to six decimals.
class RoundTrip : public MeshFolder, public ::testing::WithParamInterface<std::pair<const char*, double>> {};

TEST_P(RoundTrip, GivesBackBothPartsOfAHollowSphere) {
  const auto [extension, tolerance] = GetParam();
  const TriangleMesh outer = geodesic_sphere(5);
  TriangleMesh inner = outer;
  for (Vec3& v : inner.vertices) v *= 0.1234567890123456789;
  for (Triangle& t : inner.triangles) std::swap(t[0], t[1]);
  write_mesh(folder_ / ("s" + std::string(extension)), {outer, inner});
  const TriangleMesh back = read_mesh(folder_ / ("s" + std::string(extension)));
  ASSERT_EQ(back.triangles.size(), 2 * outer.triangles.size());
  EXPECT_EQ(back.vertices.size(), 2 * outer.vertices.size());
  for (std::size_t t = 0; t < back.triangles.size(); ++t) {
    const TriangleMesh& part = t < outer.triangles.size() ? outer : inner;
    const Triangle& want = part.triangles[t % outer.triangles.size()];
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LE((back.vertices[back.triangles[t][k]] - part.vertices[want[k]]).cwiseAbs().maxCoeff(),
                tolerance);
  }
}

constexpr double half_ulp = 0.5 * double(std::numeric_limits<float>::epsilon());
INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         ::testing::Values(std::pair{".stl", half_ulp}, std::pair{".3mf", half_ulp},
                                           std::pair{".obj", 0.0}, std::pair{".ply", 0.0},
                                           std::pair{".off", 0.0}),
                         [](const auto& format) { return std::string(format.param.first).substr(1); });

}  // namespace THIS_FILE
}  // namespace kreisel::core
