#include "session/provenance.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include "session/build_info.hpp"
#include "solve/ipopt.hpp"

namespace kreisel::core {
namespace {

std::string processor_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

/// The library that ended up behind the BLAS interface; MUMPS' time depends on it.
std::string blas_name() {
  std::ifstream in("/proc/self/maps");
  for (std::string line; std::getline(in, line);)
    for (const char* name : {"openblas", "atlas", "mkl", "blis", "libblas"})
      if (const auto at = line.find(name); at != std::string::npos) return line.substr(line.find('/'));
  return "unknown";
}

}  // namespace

Provenance make_provenance(const device::Device& device) {
  Provenance p;
  p.version = build_info::version;
  p.commit = build_info::commit;
  p.compiler = build_info::compiler;
  p.build_type = build_info::build_type;
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  p.host = host.data();
  utsname system{};
  uname(&system);
  p.system = fmt::format("{} {} {}", system.sysname, system.release, system.machine);
  p.processor = processor_name();
  p.threads = std::thread::hardware_concurrency();
  p.device = device.info().name;
  p.platform = device.info().platform;
  p.driver = device.info().driver;
  p.device_version = device.info().version;
  p.device_fp64 = device.info().fp64;
  p.single_precision = device.single();
  p.ipopt_version = ipopt_version();
  p.linear_solver = "arrow, MUMPS";  // which one solved is among the solver's settings
  p.blas = blas_name();
  p.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  if (::getloadavg(&p.load, 1) != 1) p.load = 0;
  return p;
}

}  // namespace kreisel::core
