// schema.hpp - what a file says it is.
#pragma once

#include <string>
#include <string_view>

#include "record/hdf5_file.hpp"

namespace kreisel::core {

/// What files of each kind say in the attribute `schema`.
inline constexpr const char *run_schema = "kreisel run", *map_schema = "kreisel map",
                            *nest_schema = "kreisel nesting", *simulation_schema = "kreisel simulation";

/// The attribute `schema`; empty where there is none.
[[nodiscard]] std::string schema_of(const hdf5::File& file);

/// @param what    such as "a map", for the message
/// @throws InputError  another schema, or a version above `newest`
void require_schema(const hdf5::File& file, const std::string& name, std::string_view what,
                    std::string_view schema, int newest);

}  // namespace kreisel::core
