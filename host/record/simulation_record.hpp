// simulation_record.hpp - simulations as HDF5 files and as JSON, and records of runs as what to simulate.
// Schema: results/README.md.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "run/simulation.hpp"

namespace kreisel::core {

inline constexpr int simulation_schema_version = 1;

/// What a record of a run holds: its solid and the part that it wrote.
/// @throws InputError  not a record of a run, or of one that failed or found no part
[[nodiscard]] Subject subject_of_record(const std::filesystem::path& path, device::Device& device);

/// Temporary name in the same folder, then renamed. @throws InputError  the folder cannot be written
void write_simulation(const std::filesystem::path& path, const Simulation& simulation);

/// A simulation that ended in an error: configuration, provenance and the message.
/// @throws InputError  the folder cannot be written
void write_simulation_failure(const std::filesystem::path& path, const SimulationRun& run,
                              const Provenance& provenance, const std::string& message);

/// What tables need of a simulation's record.
struct SimulationSummary {
  std::filesystem::path path;
  std::map<std::string, std::string> config;  ///< as describe() gives it
  std::string error;  ///< of a failed run; then there is only what was asked for, by whom and where
  std::string model, problem, termination;
  bool made = true;     ///< there is a part
  std::string contact;  ///< empty: nothing was set spinning
  double rpm = 0;
  struct Body {
    std::optional<StableAbove> above;
    std::string spectrum;  ///< "stable", "unstable", "no steady spin"
    double largest_tilt_degrees = 0;
    std::optional<double> fell_at;  ///< s
  };
  Body solid, part;
  std::string commit, device, started;
  std::optional<double> load;
};

/// @throws InputError  not a simulation's record, or of a newer schema
[[nodiscard]] SimulationSummary read_simulation(const std::filesystem::path& path);

/// With the field names of docs/output.md.
[[nodiscard]] nlohmann::json to_json(const Simulation& simulation);

}  // namespace kreisel::core
