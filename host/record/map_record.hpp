// map_record.hpp - a map of orientations as an HDF5 file and as JSON. Schema: results/README.md.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "record/record.hpp"
#include "session/orientation_map.hpp"

namespace kreisel::core {

/// Temporary name in the same folder, then renamed. @throws InputError  the folder cannot be written
void write_map(const std::filesystem::path& path, const OrientationMap& map);

/// As it was written; verdicts without their words, but for the best.
/// @throws InputError  not a map's record, or of a newer schema
[[nodiscard]] OrientationMap read_map(const std::filesystem::path& path);

/// Summary and every axis, with the field names of docs/output.md.
[[nodiscard]] nlohmann::json to_json(const OrientationMap& map);

}  // namespace kreisel::core
