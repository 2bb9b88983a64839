#include "body/models.hpp"

#include "body/models/shapes.hpp"

namespace kreisel {

const std::vector<Model>& models() {
  static const std::vector<Model> all = {
      {.name = "ellipsoid",
       .summary = "tilted ellipsoid, 60 x 39 x 38.25 mm, spins about z",
       .make = ellipsoid_shape},
      {.name = "bird",
       .summary = "plump bird, 60 x 45 x 45 mm, spins about z on a peg under its belly",
       .make = bird_shape,
       // 1.4 mm from the vertical through the centre of mass: far enough that the solid cannot spin, near
       // enough that the coarsest grid of [RayRep, table 2] is feasible with the midpoint bounds too.
       .contact = Vec3(27.0, 22.4, 0.0)},
  };
  return all;
}

const Model* find_model(std::string_view name) {
  for (const Model& model : models())
    if (model.name == name) return &model;
  return nullptr;
}

}  // namespace kreisel
