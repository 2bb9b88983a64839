#include "file/replace_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "error.hpp"

namespace kreisel::core {
namespace fs = std::filesystem;

namespace {

/// The name of a temporary file where a signal handler finds it: no memory is taken or given back.
struct Slot {
  std::atomic<bool> taken = false, ready = false;
  std::array<char, 4096> name;
};

std::array<Slot, 16>& slots() {
  static std::array<Slot, 16> all;
  return all;
}

/// Removes the file in the end; once it has been renamed there is nothing left to remove.
class Temporary {
 public:
  explicit Temporary(fs::path at) : path(std::move(at)) {
    if (path.native().size() >= std::tuple_size_v<decltype(Slot::name)>) return;
    for (Slot& slot : slots())
      if (!slot.taken.exchange(true)) {
        std::memcpy(slot.name.data(), path.c_str(), path.native().size() + 1);
        slot.ready = true;
        slot_ = &slot;
        return;
      }
  }
  ~Temporary() {
    std::error_code ignored;
    fs::remove(path, ignored);
    if (!slot_) return;
    slot_->ready = false;
    slot_->taken = false;
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const fs::path path;

 private:
  Slot* slot_ = nullptr;  ///< none where there are too many at a time
};

constexpr std::string_view suffix = ".tmp";

/// Names in a folder that end as temporary ones do, when this process first wrote there: a sweep writes a
/// hundred thousand files into one, and a look at all of them for each would take longer than its runs.
std::vector<std::string> temporary_names_in(const fs::path& folder) {
  static std::mutex looking;
  static std::map<fs::path, std::vector<std::string>> seen;
  const std::scoped_lock lock(looking);
  const auto [known, is_new] = seen.try_emplace(folder);
  std::error_code error;
  if (is_new)
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
      if (std::string name = entry.path().filename().string(); name.ends_with(suffix))
        known->second.push_back(std::move(name));
  return known->second;
}

/// What a run that was killed has left: temporary names of this file whose process is gone. Those of an hour
/// are left alone: on a folder that machines share the process may be another's.
void sweep_stale(const fs::path& path) {
  const std::string prefix = path.filename().string() + ".";
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  for (const std::string& name : temporary_names_in(folder)) {
    if (!name.starts_with(prefix)) continue;
    const char* begin = name.data() + prefix.size();
    pid_t process = 0;
    const auto [end, status] = std::from_chars(begin, name.data() + name.size() - suffix.size(), process);
    if (status != std::errc() || process <= 0) continue;
    std::error_code error;
    const auto age = fs::file_time_type::clock::now() - fs::last_write_time(folder / name, error);
    if (error || age < std::chrono::hours(1)) continue;
    if (::kill(process, 0) != 0 && errno == ESRCH) fs::remove(folder / name, error);
  }
}

/// Of the kind that the system opens anew as what it is open as already.
bool is_open_file(const fs::path& path) {
  const std::string name = path.string();
  return name.starts_with("/dev/fd/") ||
         (name.starts_with("/proc/") && name.find("/fd/") != std::string::npos);
}

/// Follows links until `done(path)` or the path is none; gives up on a circle.
template <class Done>
fs::path follow_links(fs::path path, const Done& done) {
  constexpr int most = 40;  // as the system does
  std::error_code error;
  for (int links = 0; links < most && !done(path); ++links) {
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

/// A descriptor to write to. What this process has open is written to where it has got to.
int open_in_place(const fs::path& path) {
  const fs::path opened = follow_links(path, is_open_file);
  const std::string name = opened.string();
  for (const std::string_view own : {"/proc/self/fd/", "/dev/fd/"})
    if (name.starts_with(own)) {
      int number = -1;
      const char* end = name.data() + name.size();
      const auto [stop, status] = std::from_chars(name.data() + own.size(), end, number);
      if (status != std::errc() || stop != end) break;
      (void)std::fflush(stdout);  // what was printed earlier comes first
      return ::dup(number);
    }
  return ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
}

void copy_into(const fs::path& from, const fs::path& path) {
  const int to = open_in_place(path);
  const auto refuse = [&] {
    const std::string why = std::strerror(errno);
    if (to >= 0) ::close(to);
    throw InputError(fmt::format(
        "{}: cannot be written ({}), expected a file, pipe or device that takes data", path.string(), why));
  };
  if (to < 0) refuse();
  std::ifstream in(from, std::ios::binary);
  std::string block(1 << 16, '\0');
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())), in.gcount() > 0)
    for (std::size_t sent = 0; sent < std::size_t(in.gcount());) {
      const ssize_t got = ::write(to, block.data() + sent, std::size_t(in.gcount()) - sent);
      if (got < 0 && errno != EINTR) refuse();
      if (got > 0) sent += std::size_t(got);
    }
  ::close(to);
}

/// A name of this process alone. @param beside  in its folder: a rename never crosses file systems
fs::path temporary_name(const fs::path& beside) {
  static std::atomic<int> count = 0;  // two threads may write to one name
  fs::path name = beside;
  return name += fmt::format(".{}-{}.tmp", ::getpid(), count++);
}

}  // namespace

fs::path written_path(const fs::path& path) {
  return follow_links(path, [](const fs::path&) { return false; });
}

bool is_written_in_place(const fs::path& path) {
  if (is_open_file(follow_links(path, is_open_file))) return true;
  std::error_code ignored;
  return fs::is_other(fs::status(path, ignored));
}

void replace_file(const fs::path& name, const std::function<void(const fs::path& temporary)>& write) {
  if (!name.has_filename())
    throw InputError(fmt::format("'{}': no file name, expected one to write to", name.string()));
  std::error_code error;
  if (is_written_in_place(name)) {
    const Temporary temporary{temporary_name(fs::temp_directory_path() / "kreisel")};
    write(temporary.path);
    copy_into(temporary.path, name);
    return;
  }
  const fs::path path = written_path(name);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  fs::create_directories(folder, error);
  if (error)
    throw InputError(fmt::format("{}: folder {} cannot be made ({}), expected one to write into",
                                 path.string(), folder.string(), error.message()));

  sweep_stale(path);
  const Temporary temporary{temporary_name(path)};
  write(temporary.path);
  const fs::file_status earlier = fs::status(path, error);
  if (fs::is_regular_file(earlier)) fs::permissions(temporary.path, earlier.permissions(), error);
  fs::rename(temporary.path, path, error);
  if (error) throw InputError(fmt::format("{}: {}, expected a file name", path.string(), error.message()));
}

void remove_temporary_files() noexcept {
  for (Slot& slot : slots())
    if (slot.ready) (void)::unlink(slot.name.data());
}

}  // namespace kreisel::core
