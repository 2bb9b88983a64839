// common_groups.hpp - what every kind of record has.
#pragma once

#include <limits>
#include <map>
#include <string>

#include "geometry/triangle_mesh.hpp"
#include "record/hdf5_file.hpp"
#include "session/provenance.hpp"

namespace kreisel::core {

/// Where there is no number.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void write_vector(hdf5::Group& group, const std::string& name, const Vec3& v, const char* units);

/// What describe() says of a run, an attribute each.
void write_config(hdf5::Group group, const std::map<std::string, std::string>& fields);

void write_provenance(hdf5::Group group, const Provenance& p);

}  // namespace kreisel::core
