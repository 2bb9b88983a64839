#include "test_device.hpp"

namespace kreisel::core {

device::Device& test_device() {
  static device::Device device;
  return device;
}

device::Device& single_device() {
  static device::Device device({}, device::Precision::single);
  return device;
}

}  // namespace kreisel::core
