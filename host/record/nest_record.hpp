// nest_record.hpp - nesting runs as HDF5 files and as JSON, and searches on their way as HDF5 files.
// Schema: results/README.md.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "run/nest_run.hpp"

namespace kreisel::core {

inline constexpr int nest_schema_version = 1;

/// Temporary name in the same folder, then renamed. @throws InputError  the folder cannot be written
void write_nest(const std::filesystem::path& path, const NestResult& result);

/// A run that ended in an error: configuration, provenance and the message.
/// @throws InputError  the folder cannot be written
void write_nest_failure(const std::filesystem::path& path, const NestConfig& config,
                        const Provenance& provenance, const std::string& message);

/// As it was written, without outlines and shapes. Of a run that failed there is only what was asked
/// for, by whom and where.
/// @throws InputError  not a nesting's record, or of a newer schema
[[nodiscard]] NestResult read_nest(const std::filesystem::path& path);

/// With the field names of docs/output.md.
[[nodiscard]] nlohmann::json to_json(const NestResult& result);
/// What of it there is of a run that failed.
[[nodiscard]] nlohmann::json asked_json(const NestResult& result);

/// Sets what a record says was asked for.
void restore(NestConfig& config, const std::map<std::string, std::string>& texts);

/// @throws InputError  the folder cannot be written
void write_checkpoint(const std::filesystem::path& path, const NestCheckpoint& checkpoint);

/// @throws InputError  not a checkpoint, of a newer schema, or with tables of other shapes than it says
[[nodiscard]] NestCheckpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace kreisel::core
