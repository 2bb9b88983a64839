// models.hpp - parametric models that `--model NAME` accepts.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A shape the project makes itself, with the frame it is meant to be used in. Lengths in millimetres.
struct Model {
  std::string_view name;
  std::string_view summary;            ///< one line for `bench list`
  TriangleMesh (*make)(int fineness);  ///< about 20 * fineness^2 triangles; closed, outward; fineness >= 1
  Vec3 axis = Vec3::UnitZ();           ///< spin axis
  Vec3 up = axis;                      ///< as it stands or floats
  std::optional<Vec3> contact = {};    ///< a point of the axis; default the lowest point along the axis
  double size = 60;                    ///< longest side of its bounding box
  int default_fineness = 64;
};

/// Every model, in the order `bench list` prints.
[[nodiscard]] const std::vector<Model>& models();

/// The model of that name, or nullptr.
[[nodiscard]] const Model* find_model(std::string_view name);

}  // namespace kreisel::core
