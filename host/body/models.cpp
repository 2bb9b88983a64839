#include "body/models.hpp"

#include <fmt/format.h>

#include "body/models/shapes.hpp"
#include "error.hpp"

namespace kreisel::core {

void require_fineness(int fineness, int finest) {
  if (fineness < 1 || fineness > finest)
    throw InputError(fmt::format("fineness {}, expected 1 to {}", fineness, finest));
}

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
      {.name = "spheres",
       .summary = "three balls in a slanting row, 30.3 x 60 x 60 mm, to float",
       .make = spheres_shape},
      {.name = "kitten",
       .summary = "sitting kitten with a loop for a tail, 39.4 x 35.8 x 60 mm, to stand, float or spin",
       .make = kitten_shape,
       .contact = Vec3(16.6, 18.9, 0.0)},  // on the ground, in the middle of the rump
      {.name = "duck",
       .summary = "bath duck, 50.9 x 60 x 57.7 mm, to float",
       .make = duck_shape,
       .contact = Vec3(25.43, 30.7, 0.0)},  // the middle of its flat belly
      {.name = "cuboid",
       .summary = "60 x 40 x 30 mm, spins about z on a peg 3.4 mm beside its middle",
       .make = cuboid_shape,
       .contact = Vec3(27.0, 18.5, 0.0),
       .default_fineness = 10},  // flat faces gain nothing from more
      {.name = "heart",
       .summary = "heart, 60 x 29.5 x 55.2 mm, spins about z on its tip",
       .make = heart_shape,
       .contact = Vec3(30.0, 14.7445, 0.0)},
      {.name = "arrow-heart",
       .summary = "heart with an arrow through it, 60 x 55.3 x 55.2 mm, spins about the arrow on its tip",
       .make = arrow_heart_shape,
       .axis = Vec3(1, 4, 1),
       .up = Vec3::UnitZ(),
       .contact = Vec3(22.4857, 0.0953, 25.2315)},
      {.name = "dancers",
       .summary =
           "two that dance, 60 x 53.1 x 49.2 mm, to spin about z on the toes of one of them; not as they are",
       .make = dancers_shape,
       .contact = Vec3(23.5, 23.0, 0.0) * (60 / 53.91)},
      {.name = "woven-ring",
       .summary = "ring plaited from one knotted strand, 60 x 58.9 x 13.8 mm, spins about z",
       .make = woven_ring_shape,
       .contact = Vec3(30.0, 30.58251, 0.0)},  // the middle of the hole
      {.name = "teapot",
       .summary = "solid teapot with spout and handle, 60 x 36.2 x 34.5 mm, to stand or spin",
       .make = teapot_shape,
       .contact = Vec3(28.74, 18.124, 0.0)},  // the middle of its foot
      {.name = "skull",
       .summary =
           "skull with shallow sockets, nearly convex, 46.4 x 58.8 x 60 mm, to stand or to nest in itself",
       .make = skull_shape},
  };
  return all;
}

const Model* find_model(std::string_view name) {
  for (const Model& model : models())
    if (model.name == name) return &model;
  return nullptr;
}

}  // namespace kreisel::core
