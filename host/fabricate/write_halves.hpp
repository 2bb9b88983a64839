// write_halves.hpp - the parts of a yo-yo, each a file of its own.
#pragma once

#include <filesystem>
#include <vector>

#include "body/axle.hpp"
#include "body/frame.hpp"

namespace kreisel::core {

/// What of a mesh is above the middle of a yo-yo's axle, or below it; none of its triangles may cross that.
/// @param mesh  of such a body or its voids, model coordinates, mm  @param frame  the body's
[[nodiscard]] TriangleMesh half_along_axle(const Frame& frame, const TriangleMesh& mesh, bool upper);

/// Writes STEM-upper, STEM-lower and STEM-axle beside `file`, in its format, and reads each again: they are
/// watertight solids.
///
/// @param parts  outer mesh and voids of both halves, model coordinates, mm
/// @param frame  the body's
/// @return       the three files
/// @throws InputError  a file that cannot be written, or read again as a solid
std::vector<std::filesystem::path> write_halves(const std::filesystem::path& file,
                                                const std::vector<TriangleMesh>& parts, const Frame& frame,
                                                const Axle& axle);

}  // namespace kreisel::core
