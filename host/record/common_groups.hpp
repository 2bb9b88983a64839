// common_groups.hpp - groups that every kind of record has.
#pragma once

#include "record/hdf5_file.hpp"
#include "session/config.hpp"
#include "session/provenance.hpp"

namespace kreisel::core {

/// describe(config), an attribute each.
void write_config(hdf5::Group group, const RunConfig& config);

void write_provenance(hdf5::Group group, const Provenance& p);

}  // namespace kreisel::core
