// nest_groups.hpp - layers, landscapes and shapes as groups of a nesting's record, and back.
#pragma once

#include "record/hdf5_file.hpp"
#include "record/nest_record.hpp"

namespace kreisel::core {

void write_layers(hdf5::Group group, const nest::Layers& layers);
void write_landscape(hdf5::Group group, const NestResult& result);
void write_shapes(hdf5::Group group, const std::vector<TriangleMesh>& shapes);

[[nodiscard]] std::vector<LayerSummary> read_layers(const hdf5::Group& group);
[[nodiscard]] LandscapeSummary read_landscape(const hdf5::Group& group);

}  // namespace kreisel::core
