// make_part.hpp - from the optimum to the part: rounded or meshed, written, read again and judged.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "session/solved_run.hpp"

namespace kreisel::core {

/// Of a part: model coordinates, mm.
struct PartMeshes {
  TriangleMesh outer, cavity;
  std::vector<MaterialPart> solids = {};  ///< that are written
  std::size_t round = 0;                  ///< of those that were printed, which they are
};

/// Of a print: body frame and units.
struct PrintedMoments {
  Moments moments;
  bool met = false;  ///< near enough to what was asked: no further correction is tried
};

/// What else is done to a part.
struct PartOptions {
  /// Voids and islands smaller than this are left out, mm^3. Of quadrics and one material.
  double least_void = 0;
  /// How far the void's surface may be from where the quadric and the wall leave it, mm, for the sake of
  /// fewer triangles; never nearer to the skin than the wall. Of quadrics and one material.
  double tolerance = 0;
  /// Makes the solids that are written of the part's, as by cutting it. Model coordinates, mm. What this
  /// changes of the moments is made up for like what meshing changes.
  std::function<std::vector<MaterialPart>(const std::vector<MaterialPart>&)> finish = {};
  /// What a printer makes of the solids. Where there is one, that is to meet the constraints, not the mesh:
  /// it is asked once a correction, and the best part is kept. Of quadrics.
  std::function<PrintedMoments(const std::vector<MaterialPart>&)> printed = {};
  /// Writes the solids to that file, if it has a name, in place of write_parts(), and judges what it holds.
  std::function<WrittenPart(const std::string&, const std::vector<MaterialPart>&)> written = {};
};

/// Fills in what the run's result says of its part.
///
/// @param mesh_file  where it is written; empty: nowhere, and judged as it would be
/// @throws InputError   it cannot be written
/// @throws Interrupted  nothing is written
PartMeshes make_part(SolvedRun& run, const std::string& mesh_file, const PartOptions& options = {});

}  // namespace kreisel::core
