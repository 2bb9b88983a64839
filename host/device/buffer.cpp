#include "device/buffer.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "params.h"

namespace kreisel::core::device {
namespace {

constexpr std::size_t smallest_block = 1024;  // hides the cost of reduce10
constexpr std::size_t most_groups = 2048;

std::size_t block_for(std::size_t elements) {
  const std::size_t spread = (elements + most_groups - 1) / most_groups;
  return std::max(smallest_block, padded(spread));
}

}  // namespace

RealBuffer::RealBuffer(Device& device, std::size_t size)
    : device_(&device), size_(size), buffer_(checked("allocating a device array", [&] {
        const std::size_t bytes = std::max<std::size_t>(size, 1) * device.real_bytes();
        const cl::Buffer buffer(device.context(), CL_MEM_READ_WRITE, bytes);
        device.queue().enqueueFillBuffer(buffer, 0.0f, 0, bytes);
        return buffer;
      })) {}

RealBuffer::RealBuffer(Device& device, std::span<const double> values) : RealBuffer(device, values.size()) {
  upload(values);
}

void RealBuffer::upload(std::span<const double> values) {
  if (values.size() > size_) throw std::invalid_argument("upload of more values than the device array holds");
  sent_.clear();
  if (values.empty()) return;
  checked("writing a device array", [&] {
    if (device_->single()) {
      const std::vector<float> rounded(values.begin(), values.end());
      device_->queue().enqueueWriteBuffer(buffer_, CL_TRUE, 0, rounded.size() * sizeof(float),
                                          rounded.data());
    } else {
      device_->queue().enqueueWriteBuffer(buffer_, CL_TRUE, 0, values.size_bytes(), values.data());
    }
  });
}

void RealBuffer::update(std::span<const double> values) {
  if (!sent_.empty() && sent_.size() == values.size() &&
      std::memcmp(sent_.data(), values.data(), values.size_bytes()) == 0)
    return;
  upload(values);
  sent_.assign(values.begin(), values.end());
}

void RealBuffer::download(std::span<double> values, std::size_t first) const {
  if (first > size_ || values.size() > size_ - first)
    throw std::invalid_argument("download of more values than the device array holds");
  if (values.empty()) return;
  checked("reading a device array", [&] {
    if (device_->single()) {
      std::vector<float> rounded(values.size());
      device_->queue().enqueueReadBuffer(buffer_, CL_TRUE, first * sizeof(float),
                                         rounded.size() * sizeof(float), rounded.data());
      std::copy(rounded.begin(), rounded.end(), values.begin());
    } else {
      device_->queue().enqueueReadBuffer(buffer_, CL_TRUE, first * sizeof(double), values.size_bytes(),
                                         values.data());
    }
  });
}

cl::Buffer upload_words(Device& device, std::span<const std::uint32_t> words) {
  return checked("writing a device array", [&] {
    const std::size_t bytes = std::max(padded(words.size()), padding) * sizeof(std::uint32_t);
    cl::Buffer buffer(device.context(), CL_MEM_READ_ONLY, bytes);
    device.queue().enqueueFillBuffer(buffer, cl_uint{0}, 0, bytes);
    if (!words.empty())
      device.queue().enqueueWriteBuffer(buffer, CL_TRUE, 0, words.size_bytes(), words.data());
    return buffer;
  });
}

PartialRows::PartialRows(Device& device, std::size_t elements, std::size_t sums)
    : device_(&device),
      block_(static_cast<int>(block_for(elements))),
      groups_((elements + block_ - 1) / block_),
      sums_(sums),
      buffer_(checked("allocating partial sums", [&] {
        // An accumulator of single precision is a pair of floats: the size of a double.
        return cl::Buffer(device.context(), CL_MEM_WRITE_ONLY,
                          std::max<std::size_t>(groups_, 1) * sums_ * sizeof(double));
      })) {}

void PartialRows::run(const cl::Kernel& kernel) const {
  const auto items = static_cast<std::size_t>(device_->group_items());
  device_->run(kernel, groups_ * items, items);
}

std::vector<double> PartialRows::join() const {
  std::vector<double> sum(sums_);
  if (groups_ == 0) return sum;
  const auto read = [&](auto& rows) {
    checked("reading partial sums", [&] {
      device_->queue().enqueueReadBuffer(buffer_, CL_TRUE, 0, groups_ * sums_ * sizeof(double), rows.data());
    });
  };
  if (device_->single()) {
    std::vector<std::array<float, 2>> rows(groups_ * sums_);
    read(rows);
    for (std::size_t i = 0; i < rows.size(); i += sums_)
      for (std::size_t k = 0; k < sums_; ++k)
        sum[k] += static_cast<double>(rows[i + k][0]) + static_cast<double>(rows[i + k][1]);
  } else {
    std::vector<double> rows(groups_ * sums_);
    read(rows);
    for (std::size_t i = 0; i < rows.size(); i += sums_)
      for (std::size_t k = 0; k < sums_; ++k) sum[k] += rows[i + k];
  }
  return sum;
}

double PartialRows::summation_bound() const {
  // Elements one after the other, then a group's sums in four chains that are joined, then the rows. Runs
  // only shorten the chain, also where a kernel's vectors are half as long (mesh_moments.cl).
  const int group = device_->lanes() * device_->group_items();
  const double chain = static_cast<double>(block_) / group + group / 4.0 + 2 + static_cast<double>(groups_);
  const double u = device_->unit_roundoff();
  return device_->single() ? (KREISEL_RUN + 1) * u + chain * chain * u * u : chain * u;
}

}  // namespace kreisel::core::device
