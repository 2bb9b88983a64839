// pose_directions.hpp - which directions are tried where a pose is to be found.
#pragma once

#include <vector>

#include "problem/problem.hpp"
#include "session/config.hpp"

namespace kreisel::core {

struct PoseDirections {
  std::vector<Vec3> list;    ///< of length 1, model coordinates
  double spacing = 0;        ///< degrees between neighbours; 0: these are all there are
  std::optional<Vec3> near;  ///< of length 1; others are within `near_degrees` of it

  [[nodiscard]] bool holds(const Vec3& direction) const;
};
constexpr double near_degrees = 30;

/// As config.free asks; the body's own direction where nothing of it is free.
/// @param body  in whatever pose  @param choices  how many settings each will be tried with
/// @throws InputError  rest:N of a body that comes to rest in fewer ways
[[nodiscard]] PoseDirections directions_of(const RunConfig& config, const ProblemEntry& asked,
                                           const Body& body, std::size_t choices);

}  // namespace kreisel::core
