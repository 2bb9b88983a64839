// model.hpp - one model of a 3MF package, as it stands there.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "mesh/io/text.hpp"
#include "mesh/io/threemf/settings.hpp"

namespace kreisel::core::threemf {

using Transform = Eigen::Transform<double, 3, Eigen::AffineCompact>;

/// An object at a place: an item of the build, or a component.
struct Placed {
  std::string object;
  std::string path;  ///< of the model that it is in, as part_name() has it; empty: this one
  Transform transform = Transform::Identity();  ///< in the unit of this model
  Role role = {};                               ///< of an item alone
};

struct Object {
  Role role;  ///< by its type, or by what Cura says of it
  TriangleMesh mesh;
  std::vector<Placed> components;
  std::map<std::string, std::size_t> passed_over;  ///< elements of extensions that are not read
};

struct Model {
  double millimetres = 1;  ///< its unit
  std::map<std::string, Object> objects;
  std::vector<Placed> items;
  Digits digits;  ///< of all coordinates
};

/// Every number is checked here; attributes and elements that say nothing of the shape are passed over.
/// @param name  what errors call the text
/// @throws InputError  not well-formed; no 3MF; a required extension that is not read, says which; what is no
///                     number where one belongs; a triangle that names no vertex
[[nodiscard]] Model read_model(std::string_view text, const std::string& name);

}  // namespace kreisel::core::threemf
