// nest_record.hpp - nesting runs as HDF5 files and as JSON, and searches on their way as HDF5 files.
// Schema: results/README.md.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "run/nest_run.hpp"

namespace kreisel::core {

/// Temporary name in the same folder, then renamed. @throws InputError  the folder cannot be written
void write_nest(const std::filesystem::path& path, const NestResult& result);

/// As it was written, without outlines and shapes.
/// @throws InputError  not a nesting's record, or of a newer schema
[[nodiscard]] NestResult read_nest(const std::filesystem::path& path);

/// With the field names of docs/output.md.
[[nodiscard]] nlohmann::json to_json(const NestResult& result);

/// @throws InputError  the folder cannot be written
void write_checkpoint(const std::filesystem::path& path, const NestCheckpoint& checkpoint);

/// @throws InputError  not a checkpoint, of a newer schema, or with tables of other shapes than it says
[[nodiscard]] NestCheckpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace kreisel::core
