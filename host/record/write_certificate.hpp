// write_certificate.hpp - the group `certificate` of a record.
#pragma once

#include "record/hdf5_file.hpp"
#include "solve/certificate.hpp"

namespace kreisel::core {

/// Everything that the bound follows from; plots/check_certificate.py checks it again from this alone.
void write_certificate(hdf5::Group group, const Certificate& certificate);

}  // namespace kreisel::core
