#include "mesh/write_stl.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "error.hpp"
#include "mesh/check.hpp"
#include "mesh/read.hpp"

namespace kreisel {
namespace {

namespace fs = std::filesystem;

class WriteStl : public ::testing::Test {
 protected:
  WriteStl() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("kreisel_write_" + std::string(info->name()) + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  ~WriteStl() override { fs::remove_all(folder_); }

  static std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  std::size_t files() const {
    return std::size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
  }

  fs::path folder_;
};

TriangleMesh tetrahedron(double x) {
  return {{{x, 0, 0}, {x + 2, 0, 0}, {x, 2, 0}, {x, 0, 2}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

TEST_F(WriteStl, PutsHeaderCountAndOutwardUnitNormals) {
  write_stl(folder_ / "a.stl", {tetrahedron(0)});
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

TEST_F(WriteStl, PutsAllPartsIntoOneFile) {
  write_stl(folder_ / "a.stl", {tetrahedron(0), tetrahedron(10)});
  const TriangleMesh back = read_mesh(folder_ / "a.stl");
  EXPECT_EQ(back.vertices.size(), 8u);
  EXPECT_NO_THROW(require_solid(back, "two parts"));
  EXPECT_DOUBLE_EQ(inspect(back).volume, 2 * 8.0 / 6);
}

TEST_F(WriteStl, ReplacesAnEarlierFileAndLeavesNothingElse) {
  std::ofstream(folder_ / "a.stl") << "old";
  write_stl(folder_ / "a.stl", {tetrahedron(0)});
  EXPECT_EQ(bytes_of(folder_ / "a.stl").size(), 284u);
  EXPECT_EQ(files(), 1u);
}

TEST_F(WriteStl, RefusesAnAbsentFolderByName) {
  try {
    write_stl(folder_ / "gone" / "a.stl", {tetrahedron(0)});
    FAIL() << "written";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find((folder_ / "gone").string()), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("no folder"), std::string::npos) << e.what();
  }
}

TEST_F(WriteStl, LeavesNothingBehindWhenItFails) {
  fs::create_directories(folder_ / "a.stl" / "in_the_way");  // the name is taken by a folder
  EXPECT_THROW(write_stl(folder_ / "a.stl", {tetrahedron(0)}), InputError);
  EXPECT_EQ(files(), 1u);
  EXPECT_THROW(write_stl(folder_ / "b.stl", {tetrahedron(1e39)}), InputError);
  EXPECT_THROW(write_stl(folder_ / "b.stl", {tetrahedron(std::numeric_limits<double>::quiet_NaN())}),
               InputError);
  EXPECT_EQ(files(), 1u);
}

}  // namespace
}  // namespace kreisel
