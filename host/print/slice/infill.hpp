// infill.hpp - sparse infill in place of voids: what is asked for, and what slicers call it.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/io/threemf/project.hpp"

namespace kreisel::core {

struct Infill {
  double percent = 15;             ///< as slicers count it; not what it weighs, see infill_density.hpp
  std::string pattern = "gyroid";  ///< by PrusaSlicer's name

  bool operator==(const Infill&) const = default;
};

/// "15%" or "15%:grid".
/// @throws InputError  no share between 0 and 100 %, or a pattern that is unknown, or not as dense everywhere
[[nodiscard]] Infill parse_infill(std::string_view text);
/// As parse_infill() takes it.
[[nodiscard]] std::string to_string(const Infill& infill);

/// "prusa" or "orca". @throws InputError  neither
[[nodiscard]] threemf::Dialect parse_dialect(std::string_view text);

/// What is printed in one piece. Closed surfaces; model coordinates, mm.
struct Filled {
  TriangleMesh outer;
  TriangleMesh sparse = {};  ///< within it, normals out of it: where there is infill; may be empty
  Vec3 place = Vec3::Zero();
};

/// As slicers open it: full within the outer surface, but where it is sparse.
[[nodiscard]] threemf::Project project_of(const Filled& part, const Infill& infill, threemf::Dialect dialect,
                                          const Eigen::Isometry3d& to_bed);

}  // namespace kreisel::core
