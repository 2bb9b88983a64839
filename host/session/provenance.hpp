// provenance.hpp - where, with what and when a result was made.
#pragma once

#include <string>

#include "device/device.hpp"

namespace kreisel::core {

/// Stored with every result.
struct Provenance {
  std::string version, commit, compiler,
      build_type;  ///< of this program; commit ends in "-dirty" if the tree was
  std::string host, processor, system;
  unsigned threads = 0;
  std::string device, platform, driver, device_version;
  bool device_fp64 = false, single_precision = false;
  std::string ipopt_version, linear_solver, blas;
  std::string started;  ///< UTC, ISO 8601
  double load = 0;      ///< runnable threads of the whole machine, mean over the minute before `started`
};

[[nodiscard]] Provenance make_provenance(const device::Device& device);

}  // namespace kreisel::core
