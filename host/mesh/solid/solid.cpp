#include "mesh/solid/solid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "error.hpp"
#include "geometry/single_precision.hpp"
#include "geometry/triangle.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {
namespace {

std::string middle_text(const TriangleMesh& mesh, std::uint32_t triangle) {
  return fmt::format("({:.6g})", fmt::join(middle_of(mesh, mesh.triangles[triangle]), ", "));
}

/// repaired() turns triangles wherever that helps; what is left then has no two sides.
void require_orientable(Surface& surface, std::string_view name) {
  const MeshReport& report = surface.report();
  if (report.watertight() && !report.oriented())
    throw InputError(fmt::format(
        "{}: cannot be oriented, {} edges along which two triangles run the same way however they "
        "are turned; expected a surface with an inside",
        name, report.misoriented.count));
}

void require_no_self_intersections(Surface& surface, std::string_view name) {
  const TriangleMesh& mesh = surface.mesh();
  const auto& pairs = surface.crossings();
  if (pairs.empty()) return;
  const auto [first, second] = pairs.front();
  throw InputError(
      fmt::format("{}: runs through itself: {} {} of triangles intersect, the first {} at {} and {} at {}; "
                  "expected a surface without self-intersections",
                  name, pairs.size(), pairs.size() == 1 ? "pair" : "pairs", first + 1,
                  middle_text(mesh, first), second + 1, middle_text(mesh, second)));
}

/// @return  the number of cavities: shells inside another that face inward
std::size_t require_alternating_shells(Surface& surface, std::string_view name) {
  const TriangleMesh& mesh = surface.mesh();
  const auto& all = surface.shells();
  const auto& enclosing = surface.enclosing();
  std::size_t cavities = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool cavity = enclosing[i].size() % 2 == 1;
    if (cavity != (all[i].volume < 0))
      throw InputError(
          fmt::format("{}: a shell of {} triangles at {} lies inside {} and faces {}; expected {}", name,
                      all[i].triangles.size(), middle_text(mesh, all[i].triangles.front()),
                      enclosing[i].size() == 1 ? "another" : fmt::format("{} others", enclosing[i].size()),
                      cavity ? "outward" : "inward",
                      cavity ? "an inward-facing cavity: one solid within another counts its material twice"
                             : "solid and cavity in turn"));
    cavities += cavity;
  }
  return cavities;
}

/// What is to be said of a mesh that lies so far from the origin that single precision spoils it; else
/// nothing.
std::string far_away(const TriangleMesh& mesh) {
  constexpr double fine = 1e-4;  // of the mesh's length: walls are some hundredths of it
  const Box box = bounding_box(mesh);
  const double spacing = single_spacing(box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()).maxCoeff());
  const auto in_single = [](const Vec3& v) { return in_single_precision(v) == v; };
  if (!(spacing > fine * box.extent().maxCoeff()) || !std::ranges::all_of(mesh.vertices, in_single))
    return "";
  const Vec3 move = (-box.centre()).array().round() + 0.0;  // no -0
  return fmt::format(
      " (so far from the origin numbers in single precision are {:.2g} apart: move the model by {} where it "
      "was made, and save it again)",
      spacing, fmt::join(move, ","));
}

/// All checks. @return  the number of cavities
std::size_t require_sound(Surface& surface, std::string_view name) try {
  if (!surface.mesh().triangles.empty()) require_orientable(surface, name);
  require_solid(surface.mesh(), surface.report(), name);
  require_no_self_intersections(surface, name);
  return require_alternating_shells(surface, name);
} catch (const InputError& error) {
  const std::string why = surface.mesh().vertices.empty() ? "" : far_away(surface.mesh());
  if (why.empty()) throw;
  throw InputError(error.what() + why);
}

}  // namespace

void require_sound(const TriangleMesh& mesh, std::string_view name) {
  Surface surface = Surface::as_it_is(mesh);
  (void)require_sound(surface, name);
}

SolidMesh make_solid(Surface& surface, std::string_view name) {
  const std::size_t n = require_sound(surface, name);
  SolidMesh solid{surface.take_mesh(), surface.repairs()};
  if (n > 0)
    solid.repairs.lines.push_back(
        n == 1 ? "kept 1 cavity, a shell inside the solid that faces inward"
               : fmt::format("kept {} cavities, shells inside the solid that face inward", n));
  return solid;
}

SolidMesh make_solid(TriangleMesh mesh, std::string_view name) {
  Surface surface(std::move(mesh));
  return make_solid(surface, name);
}

}  // namespace kreisel::core
