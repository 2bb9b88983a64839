#include "run/nest_parts.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "body/source.hpp"
#include "error.hpp"

namespace kreisel::core {
namespace {

TriangleMesh shape_of(const std::string& model, const std::optional<double>& size, int fineness) {
  BodySpec spec;
  spec.model = model;
  if (fineness > 0) spec.fineness = fineness;
  TriangleMesh mesh = load_source(spec).mesh;
  if (size) {
    const double longest = bounding_box(mesh).extent().maxCoeff();
    if (!(longest > 0)) throw InputError(fmt::format("{} has no extent; expected a shape to scale", model));
    for (Vec3& v : mesh.vertices) v *= *size / longest;
  }
  return mesh;
}

Eigen::Matrix3d rotation_of(const Vec3& axis_times_degrees) {
  const double degrees = axis_times_degrees.norm();
  if (!(degrees > 0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis_times_degrees / degrees).toRotationMatrix();
}

}  // namespace

std::vector<TriangleMesh> shapes_of_run(const NestConfig& config) {
  std::vector<TriangleMesh> shapes{shape_of(config.outer, config.outer_size, config.fineness)};
  const bool same = (config.inner.empty() || config.inner == config.outer) && !config.inner_size;
  const auto* layers = part_of<NestLayers>(config);
  const std::vector<std::string> within = layers ? layers->within : std::vector<std::string>();
  if (!same || !within.empty())
    shapes.push_back(
        shape_of(config.inner.empty() ? config.outer : config.inner, config.inner_size, config.fineness));
  for (const std::string& model : within) shapes.push_back(shape_of(model, {}, config.fineness));
  return shapes;
}

nest::Placement unplaced(const NestTurn& turn) {
  nest::Placement placement;
  placement.pose.rotation = rotation_of(turn.rotation);
  placement.pose.scale = 1;
  placement.cut = nest::Cut::through(Vec3::Zero(), turn.plane);
  if (turn.removal) {
    placement.cut.plus = turn.removal->first.normalized();
    placement.cut.minus = turn.removal->second.normalized();
  }
  return placement;
}

nest::OptimiseSpec search_of(const NestSearch& search, const NestDecision& decision) {
  nest::OptimiseSpec spec;
  spec.freedom.set_free(search.free);
  spec.freedom.up = search.up.normalized();
  spec.variant = search.swarm;
  spec.test = decision.variant;
  spec.resolution = decision.resolution;
  spec.tolerance = decision.tolerance;
  spec.upper = decision.upper;
  spec.search = search.search;
  spec.seconds = search.seconds;
  return spec;
}

}  // namespace kreisel::core
