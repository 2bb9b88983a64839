// simulation_record.hpp - simulations as HDF5 files and as JSON, and records of runs as what to simulate.
// Schema: results/README.md.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "record/record.hpp"
#include "run/simulation.hpp"

namespace kreisel::core {

/// What a record of a run holds: its solid and the part that it wrote.
/// @throws InputError  not a record of a run, or of one that failed or found no part
[[nodiscard]] Subject subject_of_record(const std::filesystem::path& path, device::Device& device);

/// Temporary name in the same folder, then renamed. @throws InputError  the folder cannot be written
void write_simulation(const std::filesystem::path& path, const Simulation& simulation);

/// As it was written, without the motion's track.
/// @throws InputError  not a simulation, or of a newer schema
[[nodiscard]] Simulation read_simulation(const std::filesystem::path& path);

/// With the field names of docs/output.md.
[[nodiscard]] nlohmann::json to_json(const Simulation& simulation);

}  // namespace kreisel::core
