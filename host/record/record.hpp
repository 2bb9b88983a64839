// record.hpp - one HDF5 file a run, and the JSON summary that scripts rely on. Schema: results/README.md.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "file/write_text.hpp"
#include "run/run.hpp"
#include "session/result.hpp"

namespace kreisel::core {

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

/// A run as it was written, but for what grows with the resolution or the solve.
/// @throws InputError  not a record, one of a run that failed, or of a newer schema
[[nodiscard]] RunResult read_run(const std::filesystem::path& path);

/// Of such a run its timed solves alone, and how often and long it was to be timed; all else is as in a new
/// one. @throws InputError  as read_run()
[[nodiscard]] RunResult read_timing(const std::filesystem::path& path);

/// The summary with the field names of "Machine-readable output" in docs/.
[[nodiscard]] nlohmann::json to_json(const RunResult& result);

}  // namespace kreisel::core
