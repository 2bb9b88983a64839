// beside.hpp - names of files that belong to another.
#pragma once

#include <filesystem>
#include <string>

namespace kreisel::core {

/// STEM-NAME with the file's extension, in its folder.
[[nodiscard]] inline std::filesystem::path beside(const std::filesystem::path& file,
                                                  const std::string& name) {
  return file.parent_path() / (file.stem().string() + "-" + name + file.extension().string());
}

}  // namespace kreisel::core
