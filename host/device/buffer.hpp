// buffer.hpp - device arrays that the host sees in double, and the join of partial moment rows.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "device/device.hpp"

namespace kreisel::device {

/// An array of the kernels' scalar. The host side is always double; a single-precision device rounds.
class RealBuffer {
 public:
  RealBuffer(Device& device, std::size_t size);
  RealBuffer(Device& device, std::span<const double> values);

  void upload(std::span<const double> values);    ///< values.size() <= size()
  void download(std::span<double> values) const;  ///< waits for the kernels before it
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const cl::Buffer& handle() const { return buffer_; }

 private:
  Device* device_;
  std::size_t size_;
  cl::Buffer buffer_;
};

/// A constant array of 32-bit words.
cl::Buffer upload_words(Device& device, std::span<const std::uint32_t> words);

/// Rows of ten partial sums, one a work-group, as reduce10.h writes them.
class PartialRows {
 public:
  static constexpr int work_group = 64;  // WG in kernels/real.h

  PartialRows(Device& device, std::size_t elements);

  [[nodiscard]] int block() const { return block_; }                        ///< elements a work-group sums
  [[nodiscard]] std::size_t items() const { return groups_ * work_group; }  ///< work-items to launch
  [[nodiscard]] const cl::Buffer& handle() const { return buffer_; }

  /// The ten sums: rows added in order, in double.
  [[nodiscard]] std::array<double, 10> join() const;

  /// |computed - exact| <= summation_bound() * sum of |terms|, for terms given exactly: the longest chain of
  /// additions times the unit roundoff, or what compensation leaves of it (kernels/real.h).
  [[nodiscard]] double summation_bound() const;

 private:
  Device* device_;
  int block_;
  std::size_t groups_;
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

}  // namespace kreisel::device
