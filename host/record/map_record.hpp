// map_record.hpp - a map of orientations as an HDF5 file and as JSON. Schema: results/README.md.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "session/orientation_map.hpp"

namespace kreisel::core {

inline constexpr int map_schema_version = 1;

/// Temporary name in the same folder, then renamed. @throws InputError  the folder cannot be written
void write_map(const std::filesystem::path& path, const OrientationMap& map);

/// What tables and `bench show` need of a map's record.
struct MapSummary {
  std::filesystem::path path;
  std::string model, problem, through, commit, device, started;
  std::optional<double> load;  ///< none: of an early record
  std::array<int, 3> grid{};
  std::size_t rays = 0, axes = 0, asked = 0;
  double setup_seconds = 0, sweep_seconds = 0;
  struct Case {
    std::string draft;                           ///< empty for `spin`
    double feasible = 0, undecided = 0, ok = 0;  ///< shares of the axes
  };
  std::vector<Case> cases;
  struct Best {
    Vec3 axis = Vec3::UnitZ(), contact = Vec3::Zero();  ///< model coordinates, mm
    std::string draft, command;
    bool ok = false;
    double objective = 0;
    std::map<std::string, double> values;  ///< behind the verdict; NaN where a number does not exist
  };
  std::optional<Best> best;  ///< none where no axis is feasible
};

/// Is it a map's record, and not a run's? @throws InputError  no HDF5 file
[[nodiscard]] bool is_map(const std::filesystem::path& path);

/// @throws InputError  not a map's record, or of a newer schema
[[nodiscard]] MapSummary read_map(const std::filesystem::path& path);

/// Summary and every axis, with the field names of docs/output.md.
[[nodiscard]] nlohmann::json to_json(const OrientationMap& map);

}  // namespace kreisel::core
