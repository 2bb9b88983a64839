#include "device/program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>

#include "device/kernel_source.hpp"
#include "device/pocl_cache.hpp"
#include "error.hpp"
#include "file/content_key.hpp"

namespace kreisel::core::device {
namespace {

using Binary = std::vector<unsigned char>;

std::optional<Binary> read_binary(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  return Binary(std::istreambuf_iterator<char>(in), {});
}

/// Best effort: a cache that cannot be written only costs time.
void write_binary(const std::filesystem::path& path, const Binary& binary) {
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  static std::atomic<int> count = 0;  // several threads may build one kernel
  const std::filesystem::path temporary = path.string() + fmt::format(".{}-{}", ::getpid(), count++);
  std::ofstream out(temporary, std::ios::binary);
  out.write(reinterpret_cast<const char*>(binary.data()), static_cast<std::streamsize>(binary.size()));
  out.close();
  if (out)
    std::filesystem::rename(temporary, path, ignored);
  else
    std::filesystem::remove(temporary, ignored);
}

std::optional<cl::Program> from_cache(const Device& device, const std::filesystem::path& path,
                                      const std::string& options) {
  const auto binary = read_binary(path);
  if (!binary || binary->empty()) return std::nullopt;
  try {
    cl::Program program(device.context(), {device.handle()}, {*binary});
    program.build(options.c_str());
    return program;
  } catch (const cl::Error&) {
    return std::nullopt;  // another driver's or a damaged binary: build from source
  }
}

}  // namespace

std::filesystem::path cache_folder() {
  if (const char* own = std::getenv("KREISEL_CACHE_DIR")) return own;
  if (const char* xdg = std::getenv("XDG_CACHE_HOME")) return std::filesystem::path(xdg) / "kreisel";
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home ? home : "/tmp") / ".cache" / "kreisel";
}

std::string cache_key(const Device& device, std::string_view source, const std::string& options) {
  const Info& info = device.info();
  std::string all =
      fmt::format("{}\n{}\n{}\n{}\n{}\n", options, info.platform, info.name, info.version, info.driver);
  all += source;
  return content_key(all);
}

cl::Program build_source(const Device& device, std::string_view name, std::string_view source,
                         const std::string& extra) {
  const std::string options =
      fmt::format("-cl-std=CL1.2 -DLANES={} -DWG={}{}{}{}", device.lanes(), device.group_items(),
                  device.single() ? " -DKREISEL_SINGLE" : "", extra.empty() ? "" : " ", extra);
  const std::filesystem::path path = cache_folder() / (cache_key(device, source, options) + ".clbin");
  if (auto cached = from_cache(device, path, options)) return *cached;

  cl::Program program(device.context(), std::string(source));
  try {
    program.build({device.handle()}, options.c_str());
  } catch (const cl::Error& error) {
    if (device.info().platform == pocl)
      if (const std::string trouble = trouble_with_pocl_cache(); !trouble.empty()) throw InputError(trouble);
    std::string log;
    try {
      log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.handle());
    } catch (const cl::Error&) {
      log = "(the driver gives no build log)";
    }
    throw Error(fmt::format("building {}.cl for {} with '{}': {} gave {}\n{}", name, device.info().name,
                            options, error.what(), status_name(error.err()), log));
  }
  checked("reading the binary of " + std::string(name) + ".cl", [&] {
    const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
    if (!binaries.empty() && !binaries.front().empty()) write_binary(path, binaries.front());
  });
  return program;
}

cl::Program build(const Device& device, std::string_view stem, const std::string& options) {
  const std::string key = fmt::format("{} {}", stem, options);
  if (const auto built = device.programs().find(key); built != device.programs().end()) return built->second;
  for (const KernelSource& kernel : kernel_sources())
    if (kernel.stem == stem)
      return device.programs().emplace(key, build_source(device, stem, kernel.text, options)).first->second;
  throw Error(fmt::format("no kernel source '{}.cl' is embedded in this program", stem));
}

}  // namespace kreisel::core::device
