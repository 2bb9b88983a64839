// project.hpp - a part with settings of its own for what is inside it, as slicers keep it in 3MF.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "mesh/io/mesh_file.hpp"

namespace kreisel::core::threemf {

/// Who is to open it.
enum class Dialect {
  prusa,  ///< PrusaSlicer, SuperSlicer: one mesh, whose triangles Metadata/Slic3r_PE_model.config shares out
  orca,   ///< OrcaSlicer, Bambu Studio: an object of components, which Metadata/model_settings.config names
};

using Settings = std::vector<std::pair<std::string, std::string>>;  ///< in the slicer's words

/// A closed surface, and what is set within it.
struct Volume {
  std::string name;
  TriangleMesh mesh;
  bool modifier = false;  ///< no material: it changes the settings of what is inside it
  Settings settings = {};
};

/// One thing to be printed.
struct Project {
  std::string name;
  std::vector<Volume> volumes;  ///< material first; model coordinates, mm
  Vec3 place = Vec3::Zero();    ///< coordinates are written about it (place_of())
  Eigen::Isometry3d to_bed = Eigen::Isometry3d::Identity();  ///< where it is printed
  Settings settings = {};                                    ///< of all of it; of prusa, whose words they are
};

/// @param name  what errors call it  @throws InputError  a coordinate that the format cannot hold
[[nodiscard]] std::string encode_project(const Project& project, Dialect dialect, const std::string& name);

/// Its volumes where the file has them, material and modifiers, in their order; without names and settings.
/// @throws InputError  no 3MF, or none with one object to be built
[[nodiscard]] std::vector<Volume> read_project(const MeshFile& file);

}  // namespace kreisel::core::threemf
