#include "file/replace_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

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

  Temporary temporary{path};
  temporary.path += fmt::format(".{}.tmp", ::getpid());  // same folder: a rename never crosses file systems
  write(temporary.path);
  fs::rename(temporary.path, path, error);
  if (error) throw InputError(fmt::format("{}: {}, expected a file name", path.string(), error.message()));
}

}  // namespace kreisel::core
