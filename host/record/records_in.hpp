// records_in.hpp - records of any kind: which there are, and what each says.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "record/summary.hpp"

namespace kreisel::core {

enum class RecordKind { run, map, nesting, simulation };

/// What a record says, whatever its kind.
struct Record {
  std::filesystem::path path;
  RecordKind kind = RecordKind::run;
  std::string error;  ///< of a failed run; then there is only what was asked for, by whom and where
  Summary summary;    ///< with the field names of docs/output.md

  /// What was asked for, a text for each field.
  [[nodiscard]] std::map<std::string, std::string> config() const;
};

/// @throws InputError  no HDF5 file, or none that this program wrote, or of a newer schema
[[nodiscard]] RecordKind kind_of_record(const std::filesystem::path& path);

/// @throws InputError  as kind_of_record()
[[nodiscard]] Record read_record(const std::filesystem::path& path);

/// What tells whether a run is finished, and who made it: a few values, where read_record() reads all.
struct Standing {
  RecordKind kind = RecordKind::run;
  std::string error, host;  ///< as Record::error; the machine that made it, empty where it is not known
  bool complete = true;     ///< of a map: all its axes
};

/// @throws InputError  as kind_of_record()
[[nodiscard]] Standing standing_of_record(const std::filesystem::path& path);
/// The same of one that is read.
[[nodiscard]] Standing standing_of(const Record& record);

/// The file itself, or every record in the folder and those below it, sorted.
/// @throws InputError  nothing there, or no records in it
[[nodiscard]] std::vector<std::filesystem::path> records_in(const std::filesystem::path& path);

}  // namespace kreisel::core
