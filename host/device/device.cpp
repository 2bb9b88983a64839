#include "device/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <thread>

#include "device/pocl_cache.hpp"
#include "error.hpp"
#include "memory.hpp"

namespace kreisel::core::device {
namespace {

struct Found {
  Info info;
  cl::Device handle;
};

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\0' || std::isspace(static_cast<unsigned char>(text.back()))))
    text.pop_back();
  return text;
}

Info describe(const cl::Platform& platform, const cl::Device& device, int index) {
  Info info;
  info.index = index;
  info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
  info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  info.vendor = trimmed(device.getInfo<CL_DEVICE_VENDOR>());
  info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
  info.version = trimmed(device.getInfo<CL_DEVICE_VERSION>());
  info.gpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_GPU) != 0;
  info.fp64 = device.getInfo<CL_DEVICE_EXTENSIONS>().find("cl_khr_fp64") != std::string::npos;
  info.memory_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.cache_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_CACHE_SIZE>();
  info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  info.clock_mhz = device.getInfo<CL_DEVICE_MAX_CLOCK_FREQUENCY>();
  return info;
}

/// PoCL with its compiler, and for each thread a stack, a heap and the buffer that OpenBLAS may be about to
/// take (measured: 0.56 GB, and 0.2 GB a thread at the most). With less address space than that these
/// libraries crash, wait for ever, or find no device.
void require_memory() {
  const Memory memory = available_memory();
  const double need = 0.6e9 + 0.15e9 * std::max(1u, std::thread::hardware_concurrency());
  constexpr double gibi = 1 << 30;
  if (memory.limited && memory.bytes < need)
    throw MemoryError(fmt::format("OpenCL needs about {:.2g} GiB and {} {:.2g}; expected a higher limit",
                                  need / gibi, memory.of, memory.bytes / gibi));
}

std::vector<Found> find_all() {
  require_memory();
  pass_over_empty_pocl_cache();
  std::vector<Found> found;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {
    return found;  // the loader reports "no platform" as an error
  }
  for (const cl::Platform& platform : platforms) {
    std::vector<cl::Device> devices;
    try {
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    } catch (const cl::Error&) {
      continue;  // a platform without devices says CL_DEVICE_NOT_FOUND
    }
    for (const cl::Device& device : devices)
      found.push_back({describe(platform, device, static_cast<int>(found.size())), device});
  }
  return found;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

bool mentions(const Info& info, std::string_view part) {
  const std::string wanted = lower(part);
  return lower(info.name).find(wanted) != std::string::npos ||
         lower(info.platform).find(wanted) != std::string::npos ||
         (wanted == "pocl" && info.platform == pocl) || (wanted == "gpu" && info.gpu) ||
         (wanted == "cpu" && !info.gpu);
}

std::optional<int> as_index(std::string_view text) {
  int value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

const Found& pick(const std::vector<Found>& all, std::string_view selector) {
  if (all.empty()) {
    if (const std::string trouble = trouble_with_pocl_cache(); !trouble.empty())
      throw InputError("no OpenCL device found: " + trouble);
    throw InputError("no OpenCL device found; expected at least PoCL (Debian: apt install pocl-opencl-icd)");
  }
  if (selector.empty()) {
    for (const Found& f : all)
      if (f.info.gpu) return f;
    for (const Found& f : all)
      if (mentions(f.info, "pocl")) return f;
    return all.front();
  }
  const auto index = as_index(selector);
  for (const Found& f : all)
    if (index ? f.info.index == *index : mentions(f.info, selector)) return f;
  std::string names;
  for (const Found& f : all)
    names += fmt::format("{}{} = {}", names.empty() ? "" : ", ", f.info.index, f.info.name);
  throw InputError(
      fmt::format("device '{}' not found; expected an index or part of a name of: {}", selector, names));
}

/// The native vector width, as kernels/real.h can use it; 1 where the compiler makes vectors of work-items.
int lanes_of(const cl::Device& device, bool single) {
  const auto width = single ? device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>()
                            : device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE>();
  const bool gpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_GPU) != 0;
  if (gpu || width <= 1) return 1;
  return width >= 16 ? 16 : width >= 8 ? 8 : 4;
}

}  // namespace

std::vector<Info> list() {
  std::vector<Info> infos;
  for (const Found& f : find_all()) infos.push_back(f.info);
  return infos;
}

Device::Device(std::string_view selector, Precision precision) {
  const std::vector<Found> all = find_all();
  const char* environment = std::getenv("KREISEL_DEVICE");
  const Found& chosen = pick(all, selector.empty() && environment ? environment : selector);
  info_ = chosen.info;
  device_ = chosen.handle;
  // Where PoCL cannot write a kernel it ends the program, and does not say which folder it is.
  if (info_.platform == pocl)
    if (const std::string trouble = trouble_with_pocl_cache(); !trouble.empty()) throw InputError(trouble);
  single_ = precision == Precision::single || !info_.fp64;
  checked("opening " + info_.name, [&] {
    lanes_ = lanes_of(device_, single_);
    context_ = cl::Context(device_);
    queue_ = cl::CommandQueue(context_, device_, CL_QUEUE_PROFILING_ENABLE);
  });
}

Device Device::with_own_queue() const {
  Device other = *this;
  other.pending_.clear();
  other.seconds_ = 0;
  checked("opening another queue of " + info_.name,
          [&] { other.queue_ = cl::CommandQueue(context_, device_, CL_QUEUE_PROFILING_ENABLE); });
  return other;
}

void Device::run(const cl::Kernel& kernel, std::size_t items, std::size_t group) {
  if (items == 0) return;
  const std::size_t global = (items + group - 1) / group * group;
  cl::Event event;
  checked("launching " + kernel.getInfo<CL_KERNEL_FUNCTION_NAME>(), [&] {
    queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(global), cl::NDRange(group), nullptr,
                                &event);
  });
  pending_.push_back(std::move(event));
  if (pending_.size() >= 256) collect();
}

void Device::collect() {
  checked("reading kernel times", [&] {
    queue_.finish();
    for (const cl::Event& event : pending_)
      seconds_ += 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                             event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
  });
  pending_.clear();
}

double Device::kernel_seconds() {
  collect();
  return seconds_;
}

void Device::reset_kernel_seconds() {
  collect();
  seconds_ = 0;
}

std::string status_name(int code) {
  switch (code) {
#define KREISEL_STATUS(name) \
  case name:                 \
    return #name
    KREISEL_STATUS(CL_DEVICE_NOT_FOUND);
    KREISEL_STATUS(CL_DEVICE_NOT_AVAILABLE);
    KREISEL_STATUS(CL_COMPILER_NOT_AVAILABLE);
    KREISEL_STATUS(CL_MEM_OBJECT_ALLOCATION_FAILURE);
    KREISEL_STATUS(CL_OUT_OF_RESOURCES);
    KREISEL_STATUS(CL_OUT_OF_HOST_MEMORY);
    KREISEL_STATUS(CL_BUILD_PROGRAM_FAILURE);
    KREISEL_STATUS(CL_INVALID_VALUE);
    KREISEL_STATUS(CL_INVALID_KERNEL_NAME);
    KREISEL_STATUS(CL_INVALID_KERNEL_ARGS);
    KREISEL_STATUS(CL_INVALID_ARG_SIZE);
    KREISEL_STATUS(CL_INVALID_WORK_GROUP_SIZE);
    KREISEL_STATUS(CL_INVALID_BUFFER_SIZE);
#undef KREISEL_STATUS
    default:
      return fmt::format("OpenCL status {}", code);
  }
}

void throw_error(std::string_view doing, const cl::Error& error) {
  throw Error(fmt::format("{}: {} gave {}", doing, error.what(), status_name(error.err())));
}

}  // namespace kreisel::core::device
