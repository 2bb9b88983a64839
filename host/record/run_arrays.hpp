// run_arrays.hpp - what of a run grows with the resolution or the solve: written for figures and checks of
// their own, never read here.
#pragma once

#include "record/hdf5_file.hpp"
#include "session/result.hpp"

namespace kreisel::core {

void write_moments(hdf5::Group& group, const std::string& name, const Moments& s, const char* units);

/// The runs of interior cells along the rays.
void write_intervals(hdf5::Group& group, const RunResult& r);

/// x, with what one unit of it is; an octree's cells; variables of a problem's own.
void write_variables(hdf5::Group& group, const RunResult& r);

void write_history(hdf5::Group& group, const std::vector<Iterate>& history);
/// Every vertex of the undeformed body and where it went, mm.
void write_displacement(hdf5::Group& group, const DeformationReport& deformation);

/// Everything that the bound follows from.
void write_proof(hdf5::Group& group, const Certificate& c);

}  // namespace kreisel::core
