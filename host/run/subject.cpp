#include "run/subject.hpp"

#include <cmath>

#include "body/mesh_moments.hpp"
#include "body/source.hpp"
#include "error.hpp"
#include "mesh/solid/components.hpp"
#include "mesh/solid/repair.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {
namespace {

/// The surfaces that no other surface encloses.
TriangleMesh outermost(const TriangleMesh& mesh) {
  const std::vector<Shell> all = shells(mesh);
  const auto around = enclosing_shells(mesh, all);
  TriangleMesh outer;
  outer.vertices = mesh.vertices;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (around[i].empty())
      for (const std::uint32_t t : all[i].triangles) outer.triangles.push_back(mesh.triangles[t]);
  RepairReport report;  // of vertices that only the voids use
  return outer.triangles.size() == mesh.triangles.size() ? mesh : repaired(std::move(outer), report);
}

}  // namespace

Subject subject_of_mesh(const RunConfig& config, device::Device& device) {
  const BodySpec spec = find_problem(config.problem).posed(config.body);
  Source source = load_solid(spec);
  TriangleMesh whole = source.mesh;
  source.mesh = outermost(whole);
  Subject subject;
  subject.config = config;
  try {
    subject.solid = make_body(spec, std::move(source), device);
  } catch (const InputError&) {
    source.mesh = std::move(whole);
    require_unit_said(spec, source);  // in another unit all may be right
    throw;
  }
  const Body& body = subject.solid;
  subject.hollow = whole.triangles.size() != body.mesh.triangles.size();
  // As make_body() has scaled it.
  const double scale = bounding_box(body.mesh).extent().maxCoeff() / bounding_box(whole).extent().maxCoeff();
  for (Vec3& v : whole.vertices) v *= scale;
  const Moments material = reference::mesh_moments(to_body(body.frame, std::move(whole))).value;
  const Moments voids = body.solid - body.added - material;
  subject.part =
      subject.hollow ? Moments(body.solid - (1 - body.void_density / body.density) * voids) : body.solid;
  return subject;
}

Subject subject_of_run(const RunResult& r, device::Device& device) {
  return subject_of_numbers(
      r.config, {r.body_name, r.length_mm, r.mass_unit_grams, r.solid, r.verified.moments}, device);
}

Subject subject_of_numbers(const RunConfig& config, const SubjectNumbers& numbers, device::Device& device) {
  Subject subject;
  subject.config = config;
  const ProblemEntry& problem = find_problem(config.problem);
  if (problem.upright) {  // these ask for its surface, too
    subject.solid = make_body(problem.posed(config.body), device);
  } else {
    subject.solid.name = numbers.name;
    subject.solid.frame.length = numbers.length_mm;
    subject.solid.density = numbers.mass_unit_grams / std::pow(numbers.length_mm, 3) * 1e3;
    subject.solid.solid = numbers.solid;
  }
  subject.part = numbers.part;
  return subject;
}

}  // namespace kreisel::core
