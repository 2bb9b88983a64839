// module.hpp - what the module that links OpenVDB offers to who loads it.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core::openvdb_module {

/// See offset_surface(), which checks the arguments. @param result  empty before
using Offset = void(const TriangleMesh& mesh, double distance, double voxel, TriangleMesh& result);

inline constexpr const char* file = "kreisel_openvdb.so";
inline constexpr const char* function = "kreisel_offset";

}  // namespace kreisel::core::openvdb_module
