// nest_record.hpp - nesting runs as HDF5 files and as JSON, and searches on their way as HDF5 files.
// Schema: results/README.md.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "run/nest_run.hpp"

namespace kreisel::core {

inline constexpr int nest_schema_version = 1;

/// Temporary name in the same folder, then renamed. @throws InputError  the folder cannot be written
void write_nest(const std::filesystem::path& path, const NestResult& result);

/// A run that ended in an error: configuration, provenance and the message.
/// @throws InputError  the folder cannot be written
void write_nest_failure(const std::filesystem::path& path, const NestConfig& config,
                        const Provenance& provenance, const std::string& message);

/// A layer of a record.
struct LayerSummary {
  std::size_t outer = 0, inner = 0;  ///< which of the shapes
  double scale = 0, certified_scale = 0, ratio = 0, longest = 0, thickness = 0, evaluations = 0, seconds = 0;
};

/// A landscape of a record.
struct LandscapeSummary {
  int nx = 0, ny = 0, rotations = 0;
  double inside = 0, descents = 0, seconds = 0;
  double scale = 0, x = 0, y = 0, degrees = 0;  ///< of the best
};

/// What tables and `bench show` need of a nesting's record.
struct NestSummary {
  std::filesystem::path path;
  std::map<std::string, std::string> config;  ///< as describe() gives it
  std::string error;  ///< of a failed run; then there is only what was asked for, by whom and where
  std::string kind, shapes, termination, text;
  std::size_t outer_triangles = 0, inner_triangles = 0, evaluations = 0;
  bool valid = false;
  double scale = 0;
  std::optional<double> certified_scale, sampled_scale;
  double setup_seconds = 0, search_seconds = 0, certify_seconds = 0;
  struct Step {
    double evaluations, best, seconds;
  };
  std::vector<Step> trace;
  std::vector<NestTiming> timings;
  std::optional<nest::Accuracy> accuracy;
  std::vector<LayerSummary> layers;
  std::optional<LandscapeSummary> landscape;
  std::string commit, device, started;
  std::optional<double> load;  ///< none: of an early record
};

/// @throws InputError  not a nesting's record, or of a newer schema
[[nodiscard]] NestSummary read_nest(const std::filesystem::path& path);

/// With the field names of docs/output.md.
[[nodiscard]] nlohmann::json to_json(const NestResult& result);

/// @throws InputError  the folder cannot be written
void write_checkpoint(const std::filesystem::path& path, const NestCheckpoint& checkpoint);

/// @throws InputError  not a checkpoint, of a newer schema, or with tables of other shapes than it says
[[nodiscard]] NestCheckpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace kreisel::core
