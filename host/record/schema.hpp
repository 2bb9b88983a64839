// schema.hpp - what a file says it is.
#pragma once

#include <string>

#include "record/hdf5_file.hpp"

namespace kreisel::core {

/// What files of a kind say in the attributes `schema` and `schema_version`.
struct Schema {
  const char* name;
  int newest;
  const char* what;  ///< for messages
};

inline constexpr Schema run_schema = {"kreisel run", 1, "a record of a run"},
                        map_schema = {"kreisel map", 1, "a map"},
                        nest_schema = {"kreisel nesting", 1, "a nesting"},
                        simulation_schema = {"kreisel simulation", 1, "a simulation"};

/// The attribute `schema`; empty where there is none.
[[nodiscard]] std::string schema_of(const hdf5::File& file);

/// @throws InputError  another schema, or a version above the newest
void require_schema(const hdf5::File& file, const std::string& name, const Schema& schema);

}  // namespace kreisel::core
