#include "record/schema.hpp"

#include <fmt/format.h>

#include "error.hpp"

namespace kreisel::core {

std::string schema_of(const hdf5::File& file) { return file.has("schema") ? file.text("schema") : ""; }

void require_schema(const hdf5::File& file, const std::string& name, const Schema& schema) {
  if (schema_of(file) != schema.name || !file.has("schema_version"))
    throw InputError(
        fmt::format("{}: not {}, expected the attribute schema = {}", name, schema.what, schema.name));
  const std::int64_t version = file.integer("schema_version");
  if (version < 1 || version > schema.newest)
    throw InputError(fmt::format("{}: schema version {}, expected 1 to {}; a newer program wrote it", name,
                                 version, schema.newest));
}

}  // namespace kreisel::core
