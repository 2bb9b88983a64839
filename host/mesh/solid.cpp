#include "mesh/solid.hpp"

#include <fmt/format.h>

#include "error.hpp"
#include "mesh/check.hpp"
#include "mesh/components.hpp"
#include "mesh/self_intersections.hpp"

namespace kreisel {
namespace {

std::string middle_text(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3 p = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
}

/// repaired() turns triangles wherever that helps; what is left then has no two sides.
void require_orientable(const TriangleMesh& mesh, std::string_view name) {
  if (mesh.triangles.empty()) return;  // require_solid() says so
  const MeshReport report = inspect(mesh);
  if (report.watertight() && !report.oriented())
    throw InputError(fmt::format(
        "{}: cannot be oriented, {} edges along which two triangles run the same way however they "
        "are turned; expected a surface with an inside",
        name, report.misoriented.count));
}

}  // namespace

void require_no_self_intersections(const TriangleMesh& mesh, std::string_view name) {
  const auto pairs = self_intersections(mesh);
  if (pairs.empty()) return;
  const auto [first, second] = pairs.front();
  throw InputError(
      fmt::format("{}: runs through itself: {} {} of triangles intersect, the first {} at {} and {} at {}; "
                  "expected a surface without self-intersections",
                  name, pairs.size(), pairs.size() == 1 ? "pair" : "pairs", first + 1,
                  middle_text(mesh, first), second + 1, middle_text(mesh, second)));
}

std::size_t require_alternating_shells(const TriangleMesh& mesh, std::string_view name) {
  const std::vector<Shell> all = shells(mesh);
  const auto enclosing = enclosing_shells(mesh, all);
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

TriangleMesh make_solid(TriangleMesh mesh, std::string_view name, RepairReport& report) {
  mesh = repaired(std::move(mesh), report);
  require_orientable(mesh, name);
  require_solid(mesh, name);
  require_no_self_intersections(mesh, name);
  if (const std::size_t n = require_alternating_shells(mesh, name))
    report.lines.push_back(
        n == 1 ? "kept 1 cavity, a shell inside the solid that faces inward"
               : fmt::format("kept {} cavities, shells inside the solid that face inward", n));
  return mesh;
}

}  // namespace kreisel
