// records_in.hpp - records of any kind: which there are, and what each says.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace kreisel::core {

enum class RecordKind { run, map, nesting, simulation };

/// What a record says, whatever its kind.
struct Record {
  std::filesystem::path path;
  RecordKind kind = RecordKind::run;
  std::string error;       ///< of a failed run; then there is only what was asked for, by whom and where
  nlohmann::json summary;  ///< with the field names of docs/output.md

  /// What was asked for, a text for each field.
  [[nodiscard]] std::map<std::string, std::string> config() const;
};

/// @throws InputError  no HDF5 file, or none that this program wrote, or of a newer schema
[[nodiscard]] RecordKind kind_of_record(const std::filesystem::path& path);

/// @throws InputError  as kind_of_record()
[[nodiscard]] Record read_record(const std::filesystem::path& path);

/// The file itself, or every record in the folder and those below it, sorted.
/// @throws InputError  nothing there, or no records in it
[[nodiscard]] std::vector<std::filesystem::path> records_in(const std::filesystem::path& path);

}  // namespace kreisel::core
