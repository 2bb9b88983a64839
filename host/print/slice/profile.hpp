// profile.hpp - settings of a slicer, as a file of "key = value" has them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace kreisel::core {

using SlicerSettings = std::map<std::string, std::string>;

/// @param name  of the file, for messages
/// @throws InputError  a line that is neither empty, a comment (# or ;) nor key = value
[[nodiscard]] SlicerSettings parse_profile(std::string_view text, const std::string& name);

/// @throws InputError  as above, or a file that cannot be read
[[nodiscard]] SlicerSettings read_profile(const std::filesystem::path& file);

/// As the file of it has them.
[[nodiscard]] std::string profile_text(const SlicerSettings& settings);

}  // namespace kreisel::core
