// setup.hpp - what is fixed when the server starts, and no request changes.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "device/device.hpp"
#include "print/slice/slice.hpp"
#include "session/config.hpp"

namespace kreisel::core::live {

struct Limits {
  std::size_t tabs = 16;                            ///< at once
  std::size_t mesh_bytes = std::size_t{256} << 20;  ///< of a mesh that is sent
  std::size_t request_bytes = std::size_t{64} << 10;
  std::size_t unsent_bytes = std::size_t{256} << 20;  ///< to a tab that does not read
  std::size_t triangles = 4'000'000;
  double memory_bytes = 0;  ///< of the process; 0: half of what there is
};

class Setup {
 public:
  std::optional<BodySpec> given;  ///< the body of the command line
  RunConfig usual;                ///< as a question begins
  SliceSpec slicing;              ///< whose slicer is empty: nothing is sliced
  Limits limits;

  /// Opened when it is first asked for, from any thread. @throws InputError
  [[nodiscard]] const device::Device& device() const;

 private:
  mutable std::once_flag once_;
  mutable std::optional<device::Device> device_;
};

}  // namespace kreisel::core::live
