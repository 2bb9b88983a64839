#include "live/setup.hpp"

namespace kreisel::core::live {

const device::Device& Setup::device() const {
  std::call_once(once_, [&] { device_.emplace(usual.device); });
  return *device_;
}

}  // namespace kreisel::core::live
