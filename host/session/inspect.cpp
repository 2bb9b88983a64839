#include "session/inspect.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "body/moments.hpp"
#include "error.hpp"
#include "mesh/solid/check.hpp"
#include "physics/units.hpp"
#include "problem/problem.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

std::map<std::string, std::size_t> checks_of(const MeshReport& r) {
  return {{"open_edges", r.open.count},
          {"crowded_edges", r.crowded.count},
          {"misoriented_edges", r.misoriented.count},
          {"repeated_vertex_triangles", r.repeated_count},
          {"flat_triangles", r.flat_count},
          {"duplicate_triangles", r.duplicate_count},
          {"equal_vertices", r.equal_vertex_count},
          {"unused_vertices", r.unused_vertex_count},
          {"pinched_vertices", r.pinched_vertex_count}};
}

/// What each problem says of the solid as it is, of those that want it upright, or the others.
void add_verdicts(std::map<std::string, Verdict>& all, const Body& body, bool upright) {
  for (const ProblemEntry& entry : problems()) {
    if (!entry.for_solid || entry.upright != upright) continue;
    Verdict& verdict = all[entry.name];
    try {
      verdict = entry.make(entry.read(*entry.for_solid), body)->verify_at_rest(body.solid, body.frame.length);
    } catch (const InputError& error) {  // no base to stand on; heavier than water
      verdict.text = error.what();
    }
  }
}

/// The tilt by which a body topples that lies so, degrees. @param centre  of mass
double topples_at(const ConvexHull& hull, const RestingPose& pose, const Vec3& centre) {
  return degrees(std::atan2(pose.inside, pose.up.dot(centre - hull.corner(pose.facet, 0))));
}

kreisel::SolidReport solid_of(const Body& body) {
  kreisel::SolidReport s;
  const double length = body.frame.length;
  s.extent = bounding_box(body.mesh).extent();
  s.volume = length * length * length * body.solid[S1];
  s.mass = body.density * s.volume * 1e-3;
  s.centre = body.frame.to_model(centre_of_mass(body.solid));
  const Eigen::Matrix3d& r = body.frame.rotation;
  // Moments are per solid mass and length^2; rotating back gives model axes.
  const Eigen::Matrix3d inertia =
      s.mass / body.solid[S1] * length * length * r.transpose() * inertia_about_centre(body.solid) * r;
  const PrincipalAxes principal(inertia);
  s.principal = principal.moments;
  s.axes = principal.axes;
  const ConvexHull& hull = body.hull.of(body.mesh.vertices);
  for (const RestingPose& pose : resting_poses(hull, s.centre))
    if (pose.stable())
      s.rests.push_back(
          {pose.up + Vec3::Zero(), pose.probability, topples_at(hull, pose, s.centre), pose.area});
  return s;
}

}  // namespace

Inspection inspect(Source source, const BodySpec& spec, const Control& control) {
  const StopScope scope(control.stop);
  Inspection seen;
  seen.format = source.format;
  seen.vertices = source.mesh.vertices.size();
  seen.triangles = source.mesh.triangles.size();
  control.tell("check");
  Surface surface = surface_of(source);
  seen.checks = checks_of(surface.as_read());
  seen.repairs = surface.repairs().lines;
  control.tell("look for crossings");
  seen.checks["self_intersections"] = surface.crossings().size();
  if (!surface.crossings().empty()) {
    const auto& [a, b] = surface.crossings().front();
    seen.first_crossing = std::array<std::size_t, 2>{a, b};
  }
  control.tell("look for shells");
  for (std::size_t i = 0; i < surface.shells().size(); ++i) {
    const Shell& shell = surface.shells()[i];
    seen.shells.push_back({shell.triangles.size(), shell.closed, shell.euler, shell.genus, shell.volume,
                           surface.enclosing()[i].size()});
  }
  try {
    source = as_solid(std::move(source), surface, spec.model);
    surface = Surface::as_it_is({});  // a large mesh fills the memory; what its hull takes comes on top
    control.tell("weigh");
    BodySpec upright = spec;
    upright.stands_upright = true;
    const std::vector<Piece> pieces = std::move(source.pieces);
    Body body = make_body(spec, std::move(source));
    seen.repairs = body.repairs;
    body.local = {};  // a large mesh fills the memory, and what does not stand upright is judged by moments
    kreisel::SolidReport solid = solid_of(body);
    double volume = 0;
    for (const Piece& piece : pieces) volume += piece.volume;
    for (const Piece& piece : pieces) solid.pieces.push_back(solid.mass * piece.volume / volume);
    add_verdicts(solid.verdicts, body, false);
    body = reposed(std::move(body), upright);
    body.local = to_body(body.frame, body.mesh);
    body.mesh = {};  // its hull is made
    add_verdicts(solid.verdicts, body, true);
    seen.solid = std::move(solid);
  } catch (const InputError& error) {
    seen.error = error.what();
  }
  return seen;
}

}  // namespace kreisel::core
