// held.hpp - what a deformation must leave as it is.
#pragma once

#include <memory>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// How free a point is: 0 where nothing may move, 1 far from there, with continuous first derivatives.
struct Freedom {
  double value = 1;
  Vec3 gradient = Vec3::Zero();
};

/// A part of space that stays as it is. Around it a motion fades in over `blend`.
class Held {
 public:
  virtual ~Held() = default;
  [[nodiscard]] virtual Freedom at(const Vec3& x) const = 0;
};

/// The ball about `centre`.
[[nodiscard]] std::unique_ptr<Held> held_ball(const Vec3& centre, double radius, double blend);
/// What is not above z = `height`.
[[nodiscard]] std::unique_ptr<Held> held_below(double height, double blend);
/// The cylinder about the z-axis.
[[nodiscard]] std::unique_ptr<Held> held_about_axis(double radius, double blend);
/// What lies inside a closed mesh or nearer to it than `near`.
[[nodiscard]] std::unique_ptr<Held> held_inside(TriangleMesh mesh, double near, double blend);
/// All of these.
[[nodiscard]] std::unique_ptr<Held> held_together(std::vector<std::unique_ptr<Held>> parts);

}  // namespace kreisel::core
