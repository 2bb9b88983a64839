// nest.hpp - how large a copy nests inside, and can still be taken out.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "kreisel/control.hpp"
#include "kreisel/mesh.hpp"
#include "kreisel/session.hpp"

namespace kreisel {

/// One shape in another, a cut and the ways out. Coordinates of the outer mesh; the transform maps the
/// inner's into them.
struct Nesting {
  bool valid = false;
  double scale = 0, certified_scale = 0;  ///< found; proved to nest by the exact test
  Eigen::Matrix<double, 3, 4> transform = Eigen::Matrix<double, 3, 4>::Zero();
  Vec3 plane_point = Vec3::Zero(), plane_normal = Vec3::UnitZ();
  Vec3 plus = Vec3::UnitZ(), minus = -Vec3::UnitZ();  ///< ways of the halves above and below
  std::string text;                                   ///< the answer in words
  double seconds = 0;
};

/// Tests a placement, searches its scale, or with the field `free` its placement.
///
/// @param fields        those of `bench nest`, as text: {"free", "all"}, {"seconds", "10"}, {"scale", "0.5"}
/// @param on_iteration  of a search: iteration and best scale so far; false ends it and keeps the best
/// @throws InputError  fields that do not fit, meshes without extent
[[nodiscard]] KREISEL_API Nesting
nest(const Mesh& outer, const Mesh& inner, const std::map<std::string, std::string>& fields = {},
     const std::function<bool(int iteration, double scale)>& on_iteration = {}, const Control& control = {});

}  // namespace kreisel
