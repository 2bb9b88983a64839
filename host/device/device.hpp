// device.hpp - one OpenCL device with its context and in-order profiling queue.
#pragma once

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <CL/opencl.hpp>
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace kreisel::core::device {

/// A failing OpenCL call: which call, its code by name, what it worked on, and the build log if there is one.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the runtime says of a device.
struct Info {
  int index = 0;  ///< position in list(); `--device 0`
  std::string platform, name, vendor, driver, version;
  bool gpu = false;
  bool fp64 = false;
  std::uint64_t memory_bytes = 0;
  std::uint64_t cache_bytes = 0;  ///< the runtime's figure; 0 when it gives none
  unsigned compute_units = 0;
  unsigned clock_mhz = 0;
};

/// Every OpenCL device of every platform; empty when there is none. @throws MemoryError  as Device
std::vector<Info> list();

/// Scalar of the kernels: double where the device has fp64, else single with compensated sums.
enum class Precision { automatic, single };

/// A device picked by `selector`: an index of list(), or part of a device's or platform's name (any case).
/// Empty: the environment variable KREISEL_DEVICE, else the first GPU, else PoCL, else the first device.
///
/// @throws InputError   nothing matches (names what there is), or there is no device at all
/// @throws MemoryError  a limit on address space leaves less than the libraries of OpenCL take
class Device {
 public:
  explicit Device(std::string_view selector = {}, Precision precision = Precision::automatic);

  /// The same device and programs, with a queue of its own: for another thread.
  [[nodiscard]] Device with_own_queue() const;

  [[nodiscard]] const Info& info() const { return info_; }
  [[nodiscard]] bool single() const { return single_; }
  /// Unit roundoff of the kernels' scalar: 2^-24 or 2^-53.
  [[nodiscard]] double unit_roundoff() const { return single_ ? 0x1p-24 : 0x1p-53; }
  [[nodiscard]] std::size_t real_bytes() const { return single_ ? sizeof(float) : sizeof(double); }

  /// Elements a work-item takes at once and work-items of a summing group (kernels/real.h): long vectors and
  /// one item on a CPU, single elements and 64 items on a GPU.
  [[nodiscard]] int lanes() const { return lanes_; }
  [[nodiscard]] int group_items() const { return lanes_ == 1 ? 64 : 1; }

  [[nodiscard]] const cl::Context& context() const { return context_; }
  [[nodiscard]] const cl::Device& handle() const { return device_; }
  [[nodiscard]] const cl::CommandQueue& queue() const { return queue_; }
  /// Programs of embedded kernels built so far, by stem and options (program.hpp).
  [[nodiscard]] std::map<std::string, cl::Program>& programs() const { return programs_; }

  /// Runs `kernel` over `elements` elements, each by itself; the kernel leaves out what is too many.
  void run_each(const cl::Kernel& kernel, std::size_t elements) {
    const auto lanes = static_cast<std::size_t>(lanes_);
    run(kernel, (elements + lanes - 1) / lanes, 64);
  }

  /// Runs `kernel` over at least `items` work-items in groups of `group`; counts its time by profiling
  /// events.
  void run(const cl::Kernel& kernel, std::size_t items, std::size_t group);

  /// Seconds the kernels took on the device since the last reset. Waits for what is under way.
  [[nodiscard]] double kernel_seconds();
  void reset_kernel_seconds();

 private:
  void collect();

  Info info_;
  bool single_ = false;
  int lanes_ = 1;
  cl::Device device_;
  cl::Context context_;
  cl::CommandQueue queue_;
  mutable std::map<std::string, cl::Program> programs_;
  std::vector<cl::Event> pending_;
  double seconds_ = 0;
};

/// Runs `body`; an OpenCL failure inside becomes an Error that says what was being done.
template <class Body>
decltype(auto) checked(std::string_view doing, Body&& body);

/// Name of an OpenCL status code, such as "CL_OUT_OF_RESOURCES".
std::string status_name(int code);
[[noreturn]] void throw_error(std::string_view doing, const cl::Error& error);

template <class Body>
decltype(auto) checked(std::string_view doing, Body&& body) {
  try {
    return body();
  } catch (const cl::Error& error) {
    throw_error(doing, error);
  }
}

}  // namespace kreisel::core::device
