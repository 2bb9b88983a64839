#include "device/buffer.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace kreisel::device {
namespace {

constexpr std::size_t smallest_block = 1024;  // 16 elements an item hide the cost of reduce10
constexpr std::size_t most_groups = 2048;

std::size_t block_for(std::size_t elements) {
  const std::size_t spread = (elements + most_groups - 1) / most_groups;
  return std::max(smallest_block,
                  (spread + PartialRows::work_group - 1) / PartialRows::work_group * PartialRows::work_group);
}

}  // namespace

RealBuffer::RealBuffer(Device& device, std::size_t size)
    : device_(&device), size_(size), buffer_(checked("allocating a device array", [&] {
        return cl::Buffer(device.context(), CL_MEM_READ_WRITE,
                          std::max<std::size_t>(size, 1) * device.real_bytes());
      })) {}

RealBuffer::RealBuffer(Device& device, std::span<const double> values) : RealBuffer(device, values.size()) {
  upload(values);
}

void RealBuffer::upload(std::span<const double> values) {
  if (values.size() > size_) throw std::invalid_argument("upload of more values than the device array holds");
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

void RealBuffer::download(std::span<double> values) const {
  if (values.size() > size_)
    throw std::invalid_argument("download of more values than the device array holds");
  if (values.empty()) return;
  checked("reading a device array", [&] {
    if (device_->single()) {
      std::vector<float> rounded(values.size());
      device_->queue().enqueueReadBuffer(buffer_, CL_TRUE, 0, rounded.size() * sizeof(float), rounded.data());
      std::copy(rounded.begin(), rounded.end(), values.begin());
    } else {
      device_->queue().enqueueReadBuffer(buffer_, CL_TRUE, 0, values.size_bytes(), values.data());
    }
  });
}

cl::Buffer upload_words(Device& device, std::span<const std::uint32_t> words) {
  return checked("writing a device array", [&] {
    const std::size_t bytes = std::max<std::size_t>(words.size_bytes(), 4);
    cl::Buffer buffer(device.context(), CL_MEM_READ_ONLY, bytes);
    if (!words.empty())
      device.queue().enqueueWriteBuffer(buffer, CL_TRUE, 0, words.size_bytes(), words.data());
    return buffer;
  });
}

PartialRows::PartialRows(Device& device, std::size_t elements)
    : device_(&device),
      block_(static_cast<int>(block_for(elements))),
      groups_((elements + block_ - 1) / block_),
      buffer_(checked("allocating partial sums", [&] {
        // An accumulator of single precision is a pair of floats: the size of a double.
        return cl::Buffer(device.context(), CL_MEM_WRITE_ONLY,
                          std::max<std::size_t>(groups_, 1) * 10 * sizeof(double));
      })) {}

std::array<double, 10> PartialRows::join() const {
  std::array<double, 10> sum{};
  if (groups_ == 0) return sum;
  const auto read = [&](auto& rows) {
    checked("reading partial sums", [&] {
      device_->queue().enqueueReadBuffer(buffer_, CL_TRUE, 0, groups_ * 10 * sizeof(double), rows.data());
    });
  };
  if (device_->single()) {
    std::vector<std::array<float, 2>> rows(groups_ * 10);
    read(rows);
    for (std::size_t i = 0; i < rows.size(); ++i)
      sum[i % 10] += static_cast<double>(rows[i][0]) + static_cast<double>(rows[i][1]);
  } else {
    std::vector<double> rows(groups_ * 10);
    read(rows);
    for (std::size_t i = 0; i < rows.size(); ++i) sum[i % 10] += rows[i];
  }
  return sum;
}

double PartialRows::summation_bound() const {
  const double chain = static_cast<double>(block_) / work_group + work_group + static_cast<double>(groups_);
  const double u = device_->unit_roundoff();
  return device_->single() ? 2 * u + chain * chain * u * u : chain * u;
}

}  // namespace kreisel::device
