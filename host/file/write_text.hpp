// write_text.hpp - a string into a file.
#pragma once

#include <filesystem>
#include <string>

namespace kreisel::core {

/// Writes the bytes of `text` as they are; the file appears whole or not at all (replace_file()).
/// @throws InputError  not writable, or no room
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace kreisel::core
