// test_device.hpp - the one device the tests share: PoCL in CI, or what KREISEL_DEVICE says.
#pragma once

#include "device/device.hpp"

namespace kreisel::core {

/// In double where the device has it.
device::Device& test_device();

/// The same device with its kernels forced to compensated single precision.
device::Device& single_device();

}  // namespace kreisel::core
