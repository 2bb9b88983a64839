#include "device/device.hpp"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "device/buffer.hpp"
#include "device/program.hpp"
#include "device/scoped_environment.hpp"
#include "error.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(Device, ListsAtLeastOneDeviceAndNumbersThemInOrder) {
  const std::vector<device::Info> all = device::list();
  ASSERT_FALSE(all.empty()) << "no OpenCL runtime: the tests need at least PoCL";
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].index, static_cast<int>(i));
    EXPECT_FALSE(all[i].name.empty());
    EXPECT_FALSE(all[i].platform.empty());
    EXPECT_GT(all[i].compute_units, 0u);
    EXPECT_GT(all[i].memory_bytes, 0u);
  }
}

void refuses(const std::string& wanted, const std::string& selector) {
  try {
    const device::Device device(selector);
    FAIL() << "'" << selector << "' gave " << device.info().name;
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("'" + wanted + "'"), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    for (const device::Info& info : device::list())
      EXPECT_NE(text.find(std::to_string(info.index) + " = " + info.name), std::string::npos) << text;
  }
}

TEST(Device, RefusesAnUnknownSelectorAndNamesTheDevices) {
  refuses("no such device", "no such device");
  refuses("999", "999");
  refuses("-1", "-1");
}

TEST(Device, IsFoundByIndexByNameInAnyCaseAndByKind) {
  for (const device::Info& info : device::list()) {
    EXPECT_EQ(device::Device(std::to_string(info.index)).info().index, info.index);
    std::string loud = info.name;
    for (char& c : loud) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    EXPECT_EQ(device::Device(loud).info().name, info.name);
    EXPECT_EQ(device::Device(info.gpu ? "gpu" : "cpu").info().gpu, info.gpu);
  }
}

TEST(Device, HonoursTheEnvironmentVariableUnlessASelectorIsGiven) {
  const int last = device::list().back().index;
  {
    const ScopedEnvironment variable("KREISEL_DEVICE", std::to_string(last));
    EXPECT_EQ(device::Device().info().index, last);
  }
  const ScopedEnvironment variable("KREISEL_DEVICE", "nothing of that name");
  refuses("nothing of that name", "");
  EXPECT_EQ(device::Device("0").info().index, 0);
}

TEST(Device, ForcedSinglePrecisionChangesTheScalar) {
  EXPECT_TRUE(single_device().single());
  EXPECT_EQ(single_device().unit_roundoff(), 0x1p-24);
  EXPECT_EQ(single_device().real_bytes(), sizeof(float));
  EXPECT_EQ(test_device().single(), !test_device().info().fp64);
}

TEST(Device, KernelSecondsGrowWithEveryLaunchAndReset) {
  device::Device device;
  EXPECT_EQ(device.kernel_seconds(), 0.0);
  const std::string source =
      "kernel void count(global float* out) {\n"
      "  float x = 1;\n"
      "  for (int i = 0; i < 1000; ++i) x = x * 0.5f + get_global_id(0);\n"
      "  out[get_global_id(0)] = x;\n"
      "}\n";
  cl::Kernel kernel(device::build_source(device, "count", source, ""), "count");
  const cl::Buffer out(device.context(), CL_MEM_WRITE_ONLY, 1024 * sizeof(float));
  kernel.setArg(0, out);
  double before = 0;
  for (int launch = 0; launch < 3; ++launch) {
    device.run(kernel, 1024, 64);
    const double after = device.kernel_seconds();
    EXPECT_GT(after, before) << "launch " << launch;
    EXPECT_EQ(device.kernel_seconds(), after) << "asking takes no kernel time";
    before = after;
  }
  // More launches than are kept pending: what was collected on the way still counts.
  for (int launch = 0; launch < 300; ++launch) device.run(kernel, 64, 64);
  EXPECT_GT(device.kernel_seconds(), before);
  device.run(kernel, 64, 64);
  device.reset_kernel_seconds();
  EXPECT_EQ(device.kernel_seconds(), 0.0);
}

TEST(Device, RunOfNoItemsLaunchesNothing) {
  device::Device device;
  const cl::Kernel kernel(device::build_source(device, "nothing", "kernel void nothing() {}", ""), "nothing");
  device.run(kernel, 0, 64);
  EXPECT_EQ(device.kernel_seconds(), 0.0);
}

TEST(Device, StatusCodesHaveNamesAndUnknownOnesKeepTheirNumber) {
  EXPECT_EQ(device::status_name(CL_OUT_OF_RESOURCES), "CL_OUT_OF_RESOURCES");
  EXPECT_NE(device::status_name(-4711).find("-4711"), std::string::npos);
}

TEST(Device, AFailingCallSaysWhatWasBeingDone) {
  try {
    device::checked("frobbing", [] { throw cl::Error(CL_OUT_OF_RESOURCES, "clFrob"); });
    FAIL() << "swallowed";
  } catch (const device::Error& e) {
    EXPECT_STREQ(e.what(), "frobbing: clFrob gave CL_OUT_OF_RESOURCES");
  }
}

class RealBufferOn : public testing::TestWithParam<bool> {
 protected:
  device::Device& device() { return GetParam() ? single_device() : test_device(); }
};

TEST_P(RealBufferOn, GivesBackEveryValueRoundedToTheDevicesScalar) {
  const std::vector<double> values = {0.1, -1.0 / 3, 1e-30, 12345.678, 0};
  const device::RealBuffer buffer(device(), values);
  std::vector<double> back(values.size());
  buffer.download(back);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(back[i], device().single() ? static_cast<double>(static_cast<float>(values[i])) : values[i]);
}

TEST_P(RealBufferOn, RefusesMoreValuesThanItHolds) {
  device::RealBuffer buffer(device(), 3);
  std::vector<double> four(4);
  EXPECT_THROW(buffer.upload(four), std::invalid_argument);
  EXPECT_THROW(buffer.download(four), std::invalid_argument);
  EXPECT_NO_THROW(buffer.upload({four.data(), 2}));
}

TEST_P(RealBufferOn, IsZeroAtFirstAndReadFromAnywhere) {
  device::RealBuffer buffer(device(), 5);
  buffer.upload(std::vector<double>{1, 2, 3});
  std::vector<double> back(3);
  buffer.download(back, 2);
  EXPECT_EQ(back, (std::vector<double>{3, 0, 0}));
  EXPECT_THROW(buffer.download(back, 3), std::invalid_argument);
}

TEST_P(RealBufferOn, UpdateSendsWhatDiffersFromTheLastUpdate) {
  device::RealBuffer buffer(device(), 3);
  std::vector<double> back(3);
  for (const std::vector<double>& values : {std::vector<double>{1, 2, 3}, {1, 2, 3}, {1, 2, 4}, {5, 2}}) {
    buffer.update(values);
    back.resize(values.size());
    buffer.download(back);
    EXPECT_EQ(back, values);
  }
  const std::vector<double> other = {7, 7}, last = {5, 2};
  buffer.upload(other);
  buffer.update(last);
  buffer.download(back);
  EXPECT_EQ(back, last) << "upload() in between is not forgotten";
}

TEST_P(RealBufferOn, PartialRowsOfNothingSumToZeroAndLaunchNothing) {
  const device::PartialRows rows(device(), 0);
  EXPECT_EQ(rows.groups(), 0u);
  EXPECT_EQ(rows.join(), std::vector<double>(10));
}

TEST_P(RealBufferOn, PartialRowsCoverEveryElementWithWholeWorkGroups) {
  for (const std::size_t n : {1u, 1023u, 1024u, 1025u, 2097152u, 2097153u, 10000019u}) {
    const device::PartialRows rows(device(), n);
    EXPECT_EQ(static_cast<std::size_t>(rows.block()) % device::padding, 0u) << n;
    EXPECT_GE(rows.groups() * static_cast<std::size_t>(rows.block()), n);
    EXPECT_LT((rows.groups() - 1) * static_cast<std::size_t>(rows.block()), n);
  }
}

INSTANTIATE_TEST_SUITE_P(BothPrecisions, RealBufferOn, testing::Bool(),
                         [](const auto& p) { return p.param ? "single" : "standard"; });

}  // namespace THIS_FILE
}  // namespace kreisel::core
