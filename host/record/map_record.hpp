// map_record.hpp - a map of orientations as an HDF5 file and as JSON. Schema: results/README.md.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "run/orientation_map.hpp"

namespace kreisel {

inline constexpr int map_schema_version = 1;

/// Temporary name in the same folder, then renamed. @throws InputError  the folder cannot be written
void write_map(const std::filesystem::path& path, const OrientationMap& map);

/// Summary and every axis, with the field names of docs/output.md.
[[nodiscard]] nlohmann::json to_json(const OrientationMap& map);

}  // namespace kreisel
