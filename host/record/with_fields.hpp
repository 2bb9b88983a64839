// with_fields.hpp - going over a description: into a file, out of one, into JSON.
#pragma once

#include <filesystem>

#include "record/from_hdf5.hpp"
#include "record/schema.hpp"
#include "record/summary.hpp"
#include "record/to_hdf5.hpp"
#include "record/to_json.hpp"

namespace kreisel::core::fields {

/// Keeps a summary in the record that it is of, so that who sets out a hundred thousand of them reads one
/// text each. Not a long one, which would double the file.
void keep_summary(ToHdf5& file, const nlohmann::json& summary);

/// The summary as it was kept; without values where there is none, or where another program than this wrote
/// it: then what is said of a run may be more today.
[[nodiscard]] Summary kept_summary(const hdf5::File& file);

/// Temporary name in the same folder, then renamed. @throws InputError  the folder cannot be written
template <class Describe>
void write_with(const std::filesystem::path& path, const Describe& describe) {
  hdf5::File file = hdf5::File::create(path);
  {
    ToHdf5 fields(file);  // holds groups of the file, which must be closed before it is
    describe(fields);
  }
  file.close();
}

/// @param what  such as "a map", for the message
/// @throws InputError  another schema, a version above `newest`, a field that is not there
template <class Describe>
void read_with(const std::filesystem::path& path, const Schema& schema, const Describe& describe) {
  const hdf5::File file = hdf5::File::open(path);
  require_schema(file, path.string(), schema);
  FromHdf5 fields(file, path.string());
  describe(fields);
}

template <class Describe>
[[nodiscard]] nlohmann::json json_with(const Describe& describe) {
  ToJson fields;
  describe(fields);
  return std::move(fields).json();
}

}  // namespace kreisel::core::fields
