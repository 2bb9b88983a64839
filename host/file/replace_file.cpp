#include "file/replace_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <string>

#include "error.hpp"

namespace kreisel::core {
namespace fs = std::filesystem;

namespace {

/// Removes the file in the end; once it has been renamed there is nothing left to remove.
struct Temporary {
  fs::path path;
  ~Temporary() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

/// What a run that was killed has left: temporary names of this file whose process is gone. Those of an hour
/// are left alone: on a folder that machines share the process may be another's.
void sweep_stale(const fs::path& path) {
  const std::string prefix = path.filename().string() + ".", suffix = ".tmp";
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(suffix)) continue;
    const char* begin = name.data() + prefix.size();
    pid_t process = 0;
    const auto [end, status] = std::from_chars(begin, name.data() + name.size() - suffix.size(), process);
    if (status != std::errc() || process <= 0) continue;
    const auto age = fs::file_time_type::clock::now() - entry.last_write_time(error);
    if (error || age < std::chrono::hours(1)) continue;
    if (::kill(process, 0) != 0 && errno == ESRCH) fs::remove(entry.path(), error);
  }
}

}  // namespace

void replace_file(const fs::path& path, const std::function<void(const fs::path& temporary)>& write) {
  if (!path.has_filename())
    throw InputError(fmt::format("'{}': no file name, expected one to write to", path.string()));
  std::error_code error;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  fs::create_directories(folder, error);
  if (error)
    throw InputError(fmt::format("{}: folder {} cannot be made ({}), expected one to write into",
                                 path.string(), folder.string(), error.message()));

  sweep_stale(path);
  static std::atomic<int> count = 0;  // two threads may write to one name
  Temporary temporary{path};
  temporary.path +=
      fmt::format(".{}-{}.tmp", ::getpid(), count++);  // same folder: a rename never crosses file systems
  write(temporary.path);
  fs::rename(temporary.path, path, error);
  if (error) throw InputError(fmt::format("{}: {}, expected a file name", path.string(), error.message()));
}

}  // namespace kreisel::core
