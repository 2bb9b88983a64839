#include "device/program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "device/kernel_source.hpp"
#include "device/scoped_environment.hpp"
#include "temporary_folder.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

/// Every test builds into a cache folder of its own.
class Program : public testing::Test {
 protected:
  [[nodiscard]] std::vector<fs::path> cached() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_.path)) files.push_back(entry.path());
    return files;
  }

  TemporaryFolder folder_;
  ScopedEnvironment variable_{"KREISEL_CACHE_DIR", folder_.path.string()};
};

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const std::string seven = "kernel void seven(global int* out) { out[get_global_id(0)] = VALUE; }\n";

/// Runs the kernel above.
int value_of(const cl::Program& program) {
  device::Device& device = test_device();
  cl::Kernel kernel(program, "seven");
  const cl::Buffer out(device.context(), CL_MEM_WRITE_ONLY, sizeof(int));
  kernel.setArg(0, out);
  device.run(kernel, 1, 1);
  int value = 0;
  device.queue().enqueueReadBuffer(out, CL_TRUE, 0, sizeof value, &value);
  return value;
}

TEST_F(Program, ThatDoesNotCompileThrowsWithTheBuildLog) {
  try {
    (void)device::build_source(test_device(), "broken",
                               "kernel void f(global int* a) { a[0] = frobnicate_me; }", "-DNEVER=1");
    FAIL() << "compiled";
  } catch (const device::Error& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("broken.cl"), std::string::npos) << text;
    EXPECT_NE(text.find(test_device().info().name), std::string::npos) << text;
    EXPECT_NE(text.find("-DNEVER=1"), std::string::npos) << text;
    EXPECT_NE(text.find("CL_BUILD_PROGRAM_FAILURE"), std::string::npos) << text;
    EXPECT_NE(text.find("frobnicate_me"), std::string::npos) << "no build log in: " << text;
  }
  EXPECT_TRUE(cached().empty());
}

TEST_F(Program, OfAnUnknownStemIsRefusedByName) {
  try {
    (void)device::build(test_device(), "no_such_kernel");
    FAIL() << "built";
  } catch (const device::Error& e) {
    EXPECT_NE(std::string(e.what()).find("no_such_kernel.cl"), std::string::npos) << e.what();
  }
}

TEST_F(Program, LeavesOneFileInTheCacheAndIsReadBackFromIt) {
  EXPECT_EQ(value_of(device::build_source(test_device(), "seven", seven, "-DVALUE=7")), 7);
  ASSERT_EQ(cached().size(), 1u) << "one build, one file, and no temporary left";
  const std::string first = content(cached().front());
  EXPECT_FALSE(first.empty());
  const auto written = fs::last_write_time(cached().front());
  EXPECT_EQ(value_of(device::build_source(test_device(), "seven", seven, "-DVALUE=7")), 7);
  EXPECT_EQ(cached().size(), 1u);
  EXPECT_EQ(fs::last_write_time(cached().front()), written) << "a hit writes nothing";
  EXPECT_EQ(value_of(device::build_source(test_device(), "seven", seven, "-DVALUE=8")), 8);
  EXPECT_EQ(cached().size(), 2u) << "other options are another file";
}

TEST_F(Program, IsBuiltAnewFromADamagedCacheFile) {
  (void)device::build_source(test_device(), "seven", seven, "-DVALUE=7");
  ASSERT_EQ(cached().size(), 1u);
  const fs::path file = cached().front();
  for (const std::string damage : {"", "this is no binary of any driver"}) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << damage;
    EXPECT_EQ(value_of(device::build_source(test_device(), "seven", seven, "-DVALUE=7")), 7);
    EXPECT_NE(content(file), damage) << "the damaged file stays";
  }
}

TEST_F(Program, BuildsWithoutAWritableCache) {
  const fs::path file = folder_.path / "a file, no folder";
  std::ofstream(file) << "x";
  const ScopedEnvironment variable("KREISEL_CACHE_DIR", file.string());
  EXPECT_EQ(device::cache_folder(), file);
  EXPECT_EQ(value_of(device::build_source(test_device(), "seven", seven, "-DVALUE=7")), 7);
}

TEST_F(Program, CacheFolderFollowsTheEnvironment) {
  EXPECT_EQ(device::cache_folder(), folder_.path);
  ::unsetenv("KREISEL_CACHE_DIR");  // variable_ restores it
  {
    const ScopedEnvironment xdg("XDG_CACHE_HOME", "/somewhere");
    EXPECT_EQ(device::cache_folder(), "/somewhere/kreisel");
  }
  const ScopedEnvironment xdg("XDG_CACHE_HOME", "");
  ::unsetenv("XDG_CACHE_HOME");
  const ScopedEnvironment home("HOME", "/home/of/a/test");
  EXPECT_EQ(device::cache_folder(), "/home/of/a/test/.cache/kreisel");
}

TEST_F(Program, CacheKeyChangesWithSourceAndOptions) {
  const std::string key = device::cache_key(test_device(), "source", "-DA");
  EXPECT_EQ(key.size(), 32u);
  for (const char c : key) EXPECT_TRUE(std::isxdigit(static_cast<unsigned char>(c))) << key;
  EXPECT_NE(key.substr(0, 16), key.substr(16)) << "two independent halves";
  EXPECT_EQ(device::cache_key(test_device(), "source", "-DA"), key);
  EXPECT_NE(device::cache_key(test_device(), "source ", "-DA"), key);
  EXPECT_NE(device::cache_key(test_device(), "sourcf", "-DA"), key);
  EXPECT_NE(device::cache_key(test_device(), "source", "-DB"), key);
  EXPECT_NE(device::cache_key(test_device(), "source", ""), key);
}

TEST_F(Program, OfEveryEmbeddedKernelBuildsInBothPrecisions) {
  device::Device standard, single({}, device::Precision::single);  // that have built nothing yet
  std::vector<std::string> stems;
  for (const device::KernelSource& kernel : device::kernel_sources()) {
    stems.emplace_back(kernel.stem);
    EXPECT_EQ(kernel.text.find("#include"), std::string::npos) << kernel.stem << ": includes are inlined";
    EXPECT_NO_THROW((void)device::build(standard, kernel.stem)) << kernel.stem;
    EXPECT_NO_THROW((void)device::build(single, kernel.stem)) << kernel.stem;
  }
  EXPECT_TRUE(std::ranges::is_sorted(stems));
  for (const char* wanted : {"mesh_moments", "ray_moments", "voxel_moments"})
    EXPECT_NE(std::ranges::find(stems, wanted), stems.end()) << wanted;
  EXPECT_EQ(cached().size(), stems.size() * (standard.single() ? 1 : 2));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
