#include "apps/shared/outputs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "error.hpp"
#include "file/replace_file.hpp"

namespace kreisel::core::apps {

void require_writable(const std::string& file, const char* option) {
  if (file.empty() || file == "-") return;
  std::error_code ignored;
  if (is_written_in_place(file)) {
    if (::access(file.c_str(), W_OK) != 0)
      throw InputError(
          fmt::format("{} {}: {}; expected write permission", option, file, std::strerror(errno)));
    return;
  }
  const std::filesystem::path folder = std::filesystem::absolute(written_path(file)).parent_path();
  if (!std::filesystem::is_directory(folder, ignored))
    throw InputError(
        fmt::format("{} {}; expected an existing folder, {} is none", option, file, folder.string()));
  if (std::filesystem::is_directory(file, ignored))
    throw InputError(fmt::format("{} {} is a folder; expected the name of a file", option, file));
  // By a file itself: permissions do not tell of all file systems whether they take one.
  std::string probe = (folder / ".kreisel-XXXXXX").string();  // mkstemp puts a free name for the X
  const int opened = ::mkstemp(probe.data());
  if (opened < 0)
    throw InputError(fmt::format("{} {}: folder {}: {}; expected write permission", option, file,
                                 folder.string(), std::strerror(errno)));
  ::close(opened);
  ::unlink(probe.c_str());
}

void require_replaceable(const std::string& file, const char* option) {
  if (!file.empty() && is_written_in_place(file))
    throw InputError(
        fmt::format("{} {} is no file of its own; expected one: the part is read again", option, file));
}

std::string output_error() {
  return fmt::format("standard output: {}; expected one that takes what is printed", std::strerror(errno));
}

void flush_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw InputError(output_error());
}

}  // namespace kreisel::core::apps
