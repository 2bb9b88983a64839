// record.hpp - one HDF5 file a run, and the JSON summary that scripts rely on. Schema: results/README.md.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "file/write_text.hpp"
#include "run/run.hpp"
#include "session/result.hpp"

namespace kreisel::core {

inline constexpr int record_schema_version = 1;

/// In place of a verdict where the run ended with the solve.
inline constexpr const char* no_part = "none made, none verified: part = none";

/// Writes the whole run: temporary name in the same folder, then renamed. Creates the folder.
/// @throws InputError  the folder cannot be written
void write_record(const std::filesystem::path& path, const RunResult& result);

/// A run of any kind that ended in an error before there was a result: configuration, provenance and the
/// message.
/// @throws InputError  the folder cannot be written
void write_failure(const std::filesystem::path& path, const Run& run, const Provenance& provenance,
                   const std::string& message);

/// What tables and `bench show` need of a record.
struct RecordSummary {
  std::filesystem::path path;
  std::map<std::string, std::string> config;  ///< as describe() gives it
  std::string error;  ///< of a failed run; then there is only what was asked for, by whom and where
  std::string model, problem, formulation, solver, termination, message;
  std::string scope, infeasibility;  ///< what could be asked; what cannot be met
  std::array<int, 3> grid{};
  std::size_t rays = 0, interior_voxels = 0, variables = 0;
  int iterations = 0, evaluations = 0;  ///< evaluations: of f and of its second derivatives
  double objective = 0, violation = 0;
  std::string strict_minimum;  ///< as LocalMinimum::Answer is written; empty: not asked
  std::optional<double> smallest_eigenvalue;
  std::optional<double> bound, gap;  ///< where it was certified; infinite where nothing was proved
  std::string certificate_kind;      ///< as Certificate::Kind is written; empty where it was not certified
  int certificate_boxes = 0;         ///< solved on the way
  double certificate_seconds = 0;    ///< apart from the solve
  std::string domain;                ///< columns or exact
  double whole_seconds = 0, peak_bytes = 0;  ///< 0: of an early record
  std::size_t along_voids = 0, rounds = 0;   ///< finest cells on the voids' surface, and solves, of an octree
  double rounded_objective = 0, rounded_violation = 0;
  std::size_t mended_voxels = 0, moved_voxels = 0;
  bool has_part = true;  ///< without one, `verified_text` says why, and nothing is rounded or written
  std::size_t voids = 0, islands = 0, cuts = 0;  ///< pieces of the void, loose in it, planes that open all
  bool verified_ok = false;
  std::string verified_text;
  std::map<std::string, double> verified_values;  ///< the numbers behind it
  double voids_mm3 = 0, largest_void_mm3 = 0;
  double length_mm = 1, mass_unit_grams = 1;  ///< one body unit in model units
  double solid_objective = 0;
  /// Totals in body frame and units: nothing hollowed, at the optimum, of the written file.
  Moments solid = Moments::Zero(), optimum = Moments::Zero(), written = Moments::Zero();
  Seconds median;
  std::vector<Seconds> samples;
  int repeat = 1;             ///< timed solves asked for
  double budget_seconds = 0;  ///< after which none was begun
  std::string commit, device, started;
  std::optional<double> load;  ///< none: of an early record
};

/// @throws InputError  not a record, or of a newer schema
[[nodiscard]] RecordSummary read_record(const std::filesystem::path& path);

/// The summary with the field names of "Machine-readable output" in docs/.
[[nodiscard]] nlohmann::json to_json(const RunResult& result);

}  // namespace kreisel::core
