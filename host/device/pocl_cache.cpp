#include "device/pocl_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace kreisel::core::device {
namespace {

struct Folder {
  std::string named_by;  ///< the variable that says where it is
  std::filesystem::path path;
};

/// As PoCL looks for it: its own variable, then those of the desktop.
Folder folder() {
  if (const char* own = std::getenv("POCL_CACHE_DIR"); own && *own) return {"POCL_CACHE_DIR", own};
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg)
    return {"XDG_CACHE_HOME", std::filesystem::path(xdg) / "pocl"};
  const char* home = std::getenv("HOME");
  return {"HOME", std::filesystem::path(home && *home ? home : "/tmp") / ".cache" / "pocl"};
}

}  // namespace

std::string trouble_with_pocl_cache() {
  const Folder kernels = folder();  // clang 14 takes no binding into a lambda
  const std::filesystem::path& path = kernels.path;
  const auto trouble = [&](const char* what) {
    return fmt::format(
        "PoCL's folder of kernels, {} by {}, {}; expected POCL_CACHE_DIR to name a folder that can be "
        "written",
        path.string(), kernels.named_by, what);
  };
  std::error_code failed;
  std::filesystem::create_directories(path, failed);
  if (!std::filesystem::is_directory(path, failed))
    return trouble(std::filesystem::exists(path, failed) ? "is no folder" : "cannot be made");
  const std::filesystem::path probe = path / fmt::format("kreisel-{}.tmp", ::getpid());
  const bool written = static_cast<bool>(std::ofstream(probe) << "x" << std::flush);
  std::filesystem::remove(probe, failed);
  if (!written) return trouble("cannot be written");
  constexpr std::uintmax_t kernel = 1 << 20;  // about what one takes
  const std::filesystem::space_info space = std::filesystem::space(path, failed);
  return failed || space.available >= kernel ? "" : trouble("has no room for a megabyte");
}

void pass_over_empty_pocl_cache() {
  if (const char* own = std::getenv("POCL_CACHE_DIR"); own && !*own) ::unsetenv("POCL_CACHE_DIR");
}

}  // namespace kreisel::core::device
