#include "table/data_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include "error.hpp"
#include "unknown_name.hpp"

namespace kreisel::core {
namespace fs = std::filesystem;
namespace {

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return !path.empty() && fs::is_directory(path, ignored);
}

/// NAME with the extension in one of the folders.
fs::path find_file(std::string_view kind, std::string_view name, const std::string& extension,
                   const std::vector<fs::path>& folders) {
  std::vector<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() != extension) continue;
      if (entry.path().stem() == name) return entry.path();
      names.push_back(entry.path().stem().string());
    }
  }
  std::ranges::sort(names);
  throw unknown_name(kind, name, names);
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
  // Installed data has no results/ level: nothing there is a result of ours.
  return find_file("published numbers", name, ".json", {data / "published", data / "results" / "published"});
}

fs::path figure_file(std::string_view name) {
  return find_file("figure", name, ".py", {data_folder() / "plots"});
}

}  // namespace kreisel::core
