// records_in.hpp - which records there are in a folder, and of what kind.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace kreisel::core {

enum class RecordKind { run, map, nesting, other };

/// By what the file says of itself. @throws InputError  no HDF5 file
[[nodiscard]] RecordKind kind_of_record(const std::filesystem::path& path);

/// All records below a folder, in order; or the one file.
/// @throws InputError  nothing of that name, no records in it
[[nodiscard]] std::vector<std::filesystem::path> records_in(const std::filesystem::path& path);

}  // namespace kreisel::core
