// random_placements.hpp - small shapes of every kind, and placements of one in another.
#pragma once

#include "nest/known_answers.hpp"

namespace kreisel::core::nest {

/// Shapes small enough to cast rays at all triangles: smooth, with flat walls and edges through pixel
/// centres, with a hole, with folds, running through itself.
inline std::vector<TriangleMesh> small_shapes() {
  std::vector<TriangleMesh> shapes{ball(3), ring(0.7, 0.3, 16, 8),
                                   box_mesh(Vec3::Constant(-1), Vec3::Constant(1)), letter_c_mesh(2),
                                   cylinder(0.5, 1, 16)};
  TriangleMesh crossing = ball(2);
  for (Vec3& v : crossing.vertices) v = v.cwiseProduct(Vec3(1.5, 0.8 + 0.5 * v.z(), 1));
  const TriangleMesh again =
      moved(crossing, Eigen::AngleAxisd(1, Vec3::UnitZ()).toRotationMatrix(), {0.1, 0, 0});
  const auto first = std::uint32_t(crossing.vertices.size());
  crossing.vertices.insert(crossing.vertices.end(), again.vertices.begin(), again.vertices.end());
  for (const Triangle& t : again.triangles)
    crossing.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  shapes.push_back(crossing);
  return shapes;
}

/// @param aligned  not turned, cut at z = 0, so that edges and walls line up
inline Placement random_placement(Random& random, bool aligned) {
  Placement placement;
  placement.pose.scale = uniform(random, 0.1, 0.9);
  placement.pose.centroid = random_vec(random, -0.15, 0.15);
  if (aligned) return placement;
  placement.pose.rotation = random_rotation(random);
  placement.cut = Cut::through(random_vec(random, -0.2, 0.2), random_rotation(random).col(0));
  for (Vec3* removal : {&placement.cut.plus, &placement.cut.minus})
    *removal = (*removal + random_vec(random, -0.5, 0.5)).normalized();
  return placement;
}

}  // namespace kreisel::core::nest
