#include "mesh/solid/solid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "error.hpp"
#include "geometry/single_precision.hpp"
#include "geometry/triangle.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/close_holes.hpp"
#include "mesh/solid/unite.hpp"

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

/// Whether all shells, which are closed, face outward and inward in turn.
bool alternates(Surface& surface) {
  for (std::size_t i = 0; i < surface.shells().size(); ++i)
    if ((surface.enclosing()[i].size() % 2 == 1) != (surface.shells()[i].volume < 0)) return false;
  return true;
}

/// Closed, but not such that each place is enclosed once or not at all.
bool encloses_twice(Surface& surface) {
  const MeshReport& report = surface.report();
  if (surface.mesh().triangles.empty() || report.open.count || report.repeated_count ||
      report.misoriented.count)
    return false;
  return report.crowded.count || !surface.crossings().empty() || !alternates(surface);
}

void patch_holes(Surface& surface, const Mending& mending, double millimetres) {
  TriangleMesh mesh = surface.mesh();
  const ClosedHoles closed = close_holes(mesh, *mending.close_holes / millimetres);
  if (!closed.count) return;
  RepairReport report = surface.repairs();
  report.lines.push_back(
      fmt::format("closed {} {}, up to {:.4g} mm across, by {:.4g} mm^2 of patches; {:.4g} mm^3 lie between "
                  "them and a fan "
                  "about the middle of each rim",
                  closed.count, closed.count == 1 ? "hole" : "holes", closed.widest * millimetres,
                  closed.area * millimetres * millimetres, closed.between * std::pow(millimetres, 3)));
  surface = Surface(std::move(mesh), 0, std::move(report));
}

/// Replaces a surface by the boundary of what it encloses, where it has one.
void unite_overlaps(Surface& surface, std::string_view name, InsideOut inside_out, double millimetres) {
  constexpr double negligible = 1e-6;  // of the solid: where scans fold over by less than a print shows
  auto united = unite(surface.mesh(), inside_out);
  if (!united || united->mesh.triangles.empty()) return;
  const auto mm3 = [&](double volume) {
    return fmt::format("{:.4g} mm^3", volume * std::pow(millimetres, 3));
  };
  Surface whole = Surface::as_it_is(std::move(united->mesh));
  if (inside_out == InsideOut::refused && united->inside_out > negligible * whole.report().volume)
    throw InputError(fmt::format(
        "{}: {} are enclosed inside out, at ({:.6g}); expected a surface that faces outward, or --inside-out "
        "solid or void to say what they are",
        name, mm3(united->inside_out), fmt::join(united->inside_out_at, ", ")));
  RepairReport report = surface.repairs();
  if (united->turned) report.lines.push_back("turned the surface, which was inside out");
  report.lines.push_back(
      fmt::format("united what overlaps: {} are enclosed more than once; of {} triangles {} "
                  "are as they were",
                  mm3(united->overlap), surface.mesh().triangles.size(), united->kept));
  if (united->inside_out > 0)
    report.lines.push_back(fmt::format("took {} that are enclosed inside out as {}", mm3(united->inside_out),
                                       inside_out == InsideOut::solid ? "solid" : "void"));
  surface = Surface::as_it_is(whole.take_mesh(), std::move(report));
}

/// Of several pieces those that are meant.
void take_pieces(Surface& surface, std::string_view name, const std::vector<int>& numbers, double millimetres,
                 SolidMesh& solid) {
  std::vector<Piece> chosen;
  for (const int number : numbers) {
    if (number < 1 || std::size_t(number) > solid.pieces.size())
      throw InputError(fmt::format("{}: piece {}; expected 1 to {}, counted from the heaviest", name, number,
                                   solid.pieces.size()));
    chosen.push_back(solid.pieces[std::size_t(number) - 1]);
  }
  double left = 0;
  for (const Piece& piece : solid.pieces) left += piece.volume;
  for (const Piece& piece : chosen) left -= piece.volume;
  if (chosen.size() < solid.pieces.size())
    solid.repairs.lines.push_back(fmt::format("left out {} of {} pieces, {:.4g} mm^3",
                                              solid.pieces.size() - chosen.size(), solid.pieces.size(),
                                              left * std::pow(millimetres, 3)));
  solid.mesh = mesh_of(surface, chosen);
  solid.pieces = std::move(chosen);
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

SolidMesh make_solid(Surface& surface, std::string_view name, const Mending& mending, double millimetres) {
  if (mending.close_holes && surface.report().open.count) patch_holes(surface, mending, millimetres);
  if (encloses_twice(surface)) unite_overlaps(surface, name, mending.inside_out, millimetres);
  const std::size_t n = require_sound(surface, name);
  SolidMesh solid{{}, surface.repairs(), pieces_of(surface)};
  if (mending.pieces.empty()) {
    solid.mesh = surface.take_mesh();
  } else {
    take_pieces(surface, name, mending.pieces, millimetres, solid);
  }
  if (n > 0)
    solid.repairs.lines.push_back(
        n == 1 ? "kept 1 cavity, a shell inside the solid that faces inward"
               : fmt::format("kept {} cavities, shells inside the solid that face inward", n));
  return solid;
}

SolidMesh make_solid(TriangleMesh mesh, std::string_view name, const Mending& mending) {
  Surface surface(std::move(mesh));
  return make_solid(surface, name, mending);
}

}  // namespace kreisel::core
