#include "record/records_in.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "record/schema.hpp"

namespace kreisel::core {

RecordKind kind_of_record(const std::filesystem::path& path) {
  const std::string schema = schema_of(hdf5::File::open(path));
  if (schema == run_schema) return RecordKind::run;
  if (schema == map_schema) return RecordKind::map;
  if (schema == nest_schema) return RecordKind::nesting;
  return RecordKind::other;
}

std::vector<std::filesystem::path> records_in(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path))
    throw InputError(fmt::format("{}: no such file or folder; expected records", path.string()));
  if (!std::filesystem::is_directory(path)) return {path};
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
    if (entry.path().extension() == ".h5") found.push_back(entry.path());
  if (found.empty()) throw InputError(fmt::format("{}: no records (*.h5) in it", path.string()));
  std::ranges::sort(found);
  return found;
}

}  // namespace kreisel::core
