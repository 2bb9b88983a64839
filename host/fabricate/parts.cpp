#include "fabricate/parts.hpp"

#include <utility>

#include "body/mesh_moments.hpp"
#include "fabricate/void_surface.hpp"
#include "geometry/moved.hpp"
#include "geometry/single_precision.hpp"
#include "mesh/solid/separate_edges.hpp"

namespace kreisel::core {
namespace {

VoxelSet complement(const VoxelSet& set) {
  VoxelSet other(set.domain(), false);
  for (std::size_t v = 0; v < set.size(); ++v) other.set(v, !set.solid(v));
  return other;
}

}  // namespace

Inside inside_of(const Body& body, const VoxelSet& heavy) {
  const VoxelSet fill = body.heavy_voids() ? complement(heavy) : heavy;
  Inside inside;
  inside.voids = void_surface(fill);
  if (body.heavy_voids()) (void)separate_edges(inside.voids);  // what is a manifold is the interior's surface
  if (body.one_material()) return inside;
  inside.interior = void_surface(VoxelSet(heavy.domain(), false));
  inside.fill = turned_over(void_surface(complement(fill)));
  (void)separate_edges(inside.interior);
  (void)separate_edges(inside.fill);
  return inside;
}

Inside inside_of(const Body& body, const CavityMesher& mesh, const Moments& q) {
  const Moments outside_fill = body.heavy_voids() ? Moments(-q) : q;
  Inside inside;
  inside.voids = mesh(outside_fill);
  if (body.one_material()) return inside;
  inside.interior = mesh(Moments::Unit(S1));
  inside.fill = turned_over(mesh(-outside_fill));
  return inside;
}

Moments moments_of(const Body& body, const Inside& inside) {
  // Normals into a cavity: its volume counts as less than nothing.
  const auto of = [](const TriangleMesh& mesh) { return reference::mesh_moments(mesh).value; };
  const Moments voids = of(inside.voids);
  Moments s = body.solid - body.void_density / body.density * voids;
  if (body.one_material()) return s + voids;
  return s + of(inside.interior) + body.interior_density / body.density * of(inside.fill);
}

Moments moments_of(const Body& body, const std::vector<MaterialPart>& parts) {
  Moments s = body.added;
  for (const MaterialPart& part : parts)
    for (const TriangleMesh& surface : part.surfaces)
      s += part.density / body.density * reference::mesh_moments(to_body(body.frame, surface)).value;
  return s;
}

std::vector<MaterialPart> parts_of(const Body& body, const Inside& inside) {
  const auto model = [&](const TriangleMesh& mesh) { return to_model(body.frame, mesh); };
  const TriangleMesh& cavity = body.one_material() ? inside.voids : inside.interior;
  std::vector<MaterialPart> parts = {{body.one_material() ? "part" : "shell", body.density, {body.mesh}}};
  if (!cavity.triangles.empty()) parts[0].surfaces.push_back(model(cavity));
  if (!inside.fill.triangles.empty())
    parts.push_back({"interior", body.interior_density, {model(inside.fill)}});
  if (body.void_density > 0 && !inside.voids.triangles.empty())
    parts.push_back({"filling", body.void_density, {turned_over(model(inside.voids))}});
  for (MaterialPart& part : parts) part.place = place_of(bounding_box(body.mesh));
  return parts;
}

}  // namespace kreisel::core
