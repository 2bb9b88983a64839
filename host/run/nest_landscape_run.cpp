#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>
#include <numeric>

#include "mesh/make/prism.hpp"
#include "nest/decide/exact.hpp"
#include "run/nest_parts.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

constexpr int pixels = 1024, least_directions = 16384, lanes = 64;

/// As many rays as make all rotations shifts by whole rays, and a few thousand at least.
int directions_for(int rotations) {
  const int unit = std::lcm(rotations, lanes);
  return (least_directions + unit - 1) / unit * unit;
}

/// The best of a landscape, tested in space on solids of those outlines: the outer one so tall that its ends
/// are out of reach, the inner one so flat that it does not reach anywhere.
nest::CertifiedScale certify(const NestLandscape& found, double tolerance) {
  const nest::Landscape& map = found.map;
  const double tall = 8 * map.step * std::max(map.nx, map.ny), flat = 1e-3 * tall;
  const nest::Nesting nesting(prism(found.outlines.outer, -tall / 2, tall / 2),
                              prism(found.outlines.inner, -flat / 2, flat / 2));
  const Vec2 at = map.at(map.best());
  nest::Placement placement;
  placement.pose.rotation =
      Eigen::AngleAxisd(found.degrees * std::numbers::pi / 180, Vec3::UnitZ()).toRotationMatrix();
  placement.pose.centroid = nesting.to_units(Vec3(at.x(), at.y(), 0));
  placement.pose.scale = map.scale[map.best()];
  placement.cut = nest::Cut::through(placement.pose.centroid, Vec3::UnitY());
  return nest::certify_scale(nesting, placement, tolerance);
}

}  // namespace

NestResult run_landscape(const NestConfig& config, const NestHooks& hooks) {
  require_valid(config);
  const auto& asked = std::get<NestOutlines>(config.kind);
  NestResult result;
  result.config = config;
  const Stopwatch setup;
  device::Device device(config.device);
  result.provenance = make_provenance(device);
  const std::vector<TriangleMesh> shapes = hooks.shapes.empty() ? shapes_of_run(config) : hooks.shapes;
  result.outer_triangles = shapes.front().triangles.size();
  result.inner_triangles = shapes.back().triangles.size();
  const auto outline = [&](const TriangleMesh& mesh) {
    return nest::silhouette(mesh, asked.view, asked.up, pixels);
  };
  NestLandscape found;
  found.outlines = nest::plane_shapes(outline(shapes.front()), outline(shapes.back()));
  result.setup_seconds = setup.seconds();
  nest::LandscapeSpec spec;
  spec.columns = asked.landscape;
  spec.rotations = asked.rotations;
  spec.directions = directions_for(asked.rotations);
  const Stopwatch search;
  found.map = nest::landscape(found.outlines, spec, [&](int done, int rows) {
    hooks.control.tell(fmt::format("row {} of {}, about {:.0f} s left", done, rows,
                                   search.seconds() * (static_cast<double>(rows) / done - 1)));
    return !hooks.control.stopped();
  });
  result.search_seconds = search.seconds();
  const std::size_t best = found.map.best();
  result.scale = found.map.scale[best];
  result.valid = result.scale > 0;
  found.degrees = 360.0 * found.map.rotation[best] / asked.rotations;
  result.evaluations = found.map.inside * static_cast<std::uint64_t>(asked.rotations);
  result.text = fmt::format(
      "{} x {} centroids, of which {} inside; the best at {:.6g},{:.6g}, turned by {:.4f} degrees",
      found.map.nx, found.map.ny, found.map.inside, found.map.at(best).x(), found.map.at(best).y(),
      found.degrees);
  if (!found.map.complete) result.ending = NestResult::Ending::interrupted;
  if (result.valid && found.map.complete) {
    const Stopwatch certifying;
    result.certified = certify(found, asked.tolerance);
    result.certify_seconds = certifying.seconds();
  }
  result.landscape = std::move(found);
  return result;
}

}  // namespace kreisel::core
