// surfaces.hpp - meshes as a page draws them.
#pragma once

#include "geometry/triangle_mesh.hpp"
#include "live/message.hpp"

namespace kreisel::core::live {

/// @param what  the surface's name in the head, beside "corners" and "triangles"; behind it three floats a
///              corner, model coordinates in mm, and three numbers of corners (32 bits) a triangle, both in
///              this machine's order of bytes, which is a browser's on it
[[nodiscard]] Message surface(const nlohmann::json& what, const TriangleMesh& mesh);

}  // namespace kreisel::core::live
