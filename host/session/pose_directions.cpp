#include "session/pose_directions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "error.hpp"
#include "geometry/rotation.hpp"
#include "physics/units.hpp"

namespace kreisel::core {
namespace {

std::vector<RestingPose> grounds_of(const Body& body) {
  return resting_poses(body.hull.of(body.mesh.vertices), body.frame.to_model(centre_of_mass(body.solid)));
}

Vec3 nth_rest(const Body& body, int number) {
  int stable = 0;
  for (const RestingPose& pose : grounds_of(body))
    if (pose.stable() && ++stable == number) return pose.up;
  throw InputError(fmt::format("--up rest:{} of {}, which comes to rest in {} ways; expected 1 to {}", number,
                               body.name, stable, stable));
}

/// What a body can lie on, the widest for their height first: those that can be hard to topple.
std::vector<Vec3> ways_to_lie(const Body& body, std::size_t most) {
  const Vec3 centre = body.frame.to_model(centre_of_mass(body.solid));
  const double least = 1e-4 * body.frame.length * body.frame.length;  // as resting_polygon()
  std::vector<std::pair<double, Vec3>> ways;
  const ConvexHull& hull = body.hull.of(body.mesh.vertices);
  for (const RestingPose& pose : grounds_of(body)) {
    if (pose.area < least) continue;
    const double height = pose.up.dot(centre - hull.corner(pose.facet, 0));
    ways.emplace_back(std::sqrt(pose.area) / height, pose.up);
  }
  std::ranges::stable_sort(ways, std::greater<>{}, &std::pair<double, Vec3>::first);
  std::vector<Vec3> list;
  for (const auto& [width, up] : ways)
    if (list.size() < most) list.push_back(up);
  return list;
}

}  // namespace

bool PoseDirections::holds(const Vec3& direction) const {
  return !near || direction.dot(*near) >= std::cos(near_degrees * std::numbers::pi / 180);
}

PoseDirections directions_of(const RunConfig& config, const ProblemEntry& asked, const Body& body,
                             std::size_t choices) {
  PoseDirections directions;
  if (!config.free) {
    directions.list = {body.axis};
    return directions;
  }
  if (config.body.axis) {  // it is only not said where it runs
    directions.list = {config.body.axis->normalized()};
    return directions;
  }
  if (config.free->rest) {
    directions.list = {nth_rest(body, *config.free->rest)};
    return directions;
  }
  if (config.free->near) directions.near = config.free->near->normalized();
  if (asked.poses == Poses::rest) {
    directions.list = ways_to_lie(body, 80);
  } else {
    // Where each is tried with several settings, fewer directions: they differ less than the settings do.
    const int lattice = (choices > 1 ? 60 : 600) * (directions.near ? 8 : 1);
    directions.spacing = degrees(std::sqrt(4 * std::numbers::pi / lattice));
    const PrincipalAxes principal(inertia_about_centre(body.solid));
    for (int k = 0; k < 3; ++k)
      for (const double sign : {1.0, -1.0})
        directions.list.push_back(sign * (body.frame.rotation.transpose() * principal.axes.col(k)));
    std::ranges::copy(ways_to_lie(body, choices > 1 ? 6 : 30), std::back_inserter(directions.list));
    std::ranges::copy(sphere_directions(lattice), std::back_inserter(directions.list));
  }
  if (directions.near) directions.list.insert(directions.list.begin(), *directions.near);
  std::erase_if(directions.list, [&](const Vec3& direction) { return !directions.holds(direction); });
  return directions;
}

}  // namespace kreisel::core
