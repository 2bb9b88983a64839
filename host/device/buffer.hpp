// buffer.hpp - device arrays that the host sees in double, and the join of partial moment rows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "device/device.hpp"

namespace kreisel::core::device {

/// Kernels take elements in groups of up to this many, so their arrays are padded to a multiple of it.
inline constexpr std::size_t padding = 64;

/// The least multiple of `padding` that is not below n.
[[nodiscard]] constexpr std::size_t padded(std::size_t n) { return (n + padding - 1) / padding * padding; }

/// An array of the kernels' scalar, zero at first. The host side is always double; a single-precision device
/// rounds.
class RealBuffer {
 public:
  RealBuffer(Device& device, std::size_t size);
  RealBuffer(Device& device, std::span<const double> values);

  void upload(std::span<const double> values);  ///< values.size() <= size()
  /// The same, unless these very values are the last that update() sent.
  void update(std::span<const double> values);
  /// Values from `first` on; waits for the kernels before it.
  void download(std::span<double> values, std::size_t first = 0) const;
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const cl::Buffer& handle() const { return buffer_; }

 private:
  Device* device_;
  std::size_t size_;
  cl::Buffer buffer_;
  std::vector<double> sent_;  ///< by update(); empty when nothing was
};

/// A constant array of 32-bit words, padded with zeros.
cl::Buffer upload_words(Device& device, std::span<const std::uint32_t> words);

/// Rows of partial sums, one a work-group, as reduce10.h writes them.
class PartialRows {
 public:
  PartialRows(Device& device, std::size_t elements, std::size_t sums = 10);

  [[nodiscard]] int block() const { return block_; }  ///< elements a work-group sums
  [[nodiscard]] std::size_t groups() const { return groups_; }
  [[nodiscard]] const cl::Buffer& handle() const { return buffer_; }

  /// Runs a kernel that writes these rows.
  void run(const cl::Kernel& kernel) const;

  /// The sums: rows added in order, in double.
  [[nodiscard]] std::vector<double> join() const;

  /// |computed - exact| <= summation_bound() * sum of |terms|, for terms given exactly: the longest chain of
  /// additions times the unit roundoff, or what compensation leaves of it (kernels/real.h).
  [[nodiscard]] double summation_bound() const;

 private:
  Device* device_;
  int block_;
  std::size_t groups_, sums_;
  cl::Buffer buffer_;
};

/// Sets a kernel's argument `index` to Params<real> in the device's precision; `fill` writes any Params<T>.
template <template <class> class Params, class Fill>
void set_params(const Device& device, cl::Kernel& kernel, unsigned index, Fill&& fill) {
  if (device.single()) {
    Params<float> params{};
    fill(params);
    kernel.setArg(index, sizeof params, &params);
  } else {
    Params<double> params{};
    fill(params);
    kernel.setArg(index, sizeof params, &params);
  }
}

}  // namespace kreisel::core::device
