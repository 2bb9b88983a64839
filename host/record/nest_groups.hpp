// nest_groups.hpp - what of a nesting grows with its shapes: landscapes, meshes.
#pragma once

#include "record/hdf5_file.hpp"
#include "run/nest_run.hpp"

namespace kreisel::core {

void write_landscape(hdf5::Group& group, const NestLandscape& landscape);
/// The map, without the outlines.
void read_landscape(const hdf5::Group& group, NestLandscape& landscape);

void write_shapes(hdf5::Group& group, const std::vector<TriangleMesh>& shapes);

}  // namespace kreisel::core
