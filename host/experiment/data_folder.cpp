#include "experiment/data_folder.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <system_error>

#include "error.hpp"

namespace kreisel {
namespace fs = std::filesystem;
namespace {

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return !path.empty() && fs::is_directory(path, ignored);
}

}  // namespace

fs::path data_folder() {
  // A path the user gave is not silently replaced by another one.
  if (const char* given = std::getenv("KREISEL_DATA"); given && *given) {
    if (is_folder(given)) return given;
    throw InputError(fmt::format("KREISEL_DATA: {}: no such folder, expected one with experiments/", given));
  }
  std::string tried;
  std::error_code error;
  if (const fs::path program = fs::read_symlink("/proc/self/exe", error); !error) {
    const fs::path installed = program.parent_path().parent_path() / "share" / "kreisel";
    if (is_folder(installed)) return installed;
    tried = installed.string();
  }
#ifdef KREISEL_SOURCE_DIR
  if (is_folder(KREISEL_SOURCE_DIR)) return KREISEL_SOURCE_DIR;
  tried += std::string(tried.empty() ? "" : " and ") + KREISEL_SOURCE_DIR;
#endif
  throw InputError(fmt::format("no data folder at {}, expected one there or in KREISEL_DATA", tried));
}

fs::path published_file(std::string_view name) {
  const fs::path data = data_folder();
  const std::string file = fmt::format("{}.json", name);
  // Installed data has no results/ level: nothing there is a result of ours.
  for (const fs::path& folder : {data / "published", data / "results" / "published"}) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / file, ignored)) return folder / file;
  }
  throw InputError(
      fmt::format("published numbers '{}': no {} under {}, expected a name such as rayrep_table2", name, file,
                  data.string()));
}

}  // namespace kreisel
