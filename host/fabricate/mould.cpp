#include "fabricate/mould.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "body/frame.hpp"
#include "body/mesh_moments.hpp"
#include "error.hpp"
#include "fabricate/high_places.hpp"
#include "fabricate/lay_flat.hpp"
#include "fabricate/poured.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/make/moved.hpp"
#include "mesh/make/prism.hpp"
#include "mesh/solid/components.hpp"

namespace kreisel::core {
namespace {

double volume_of(const TriangleMesh& mesh) { return reference::mesh_moments(mesh).value[S1]; }

TriangleMesh in_frame(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation) {
  return moved(mesh, Eigen::Affine3d(rotation));
}

/// The triangles of a shell as a mesh.
TriangleMesh part_of(const TriangleMesh& mesh, const Shell& shell) {
  TriangleMesh part;
  std::vector<std::uint32_t> number(mesh.vertices.size(), UINT32_MAX);
  for (const std::uint32_t t : shell.triangles) {
    Triangle triangle = mesh.triangles[t];
    for (std::uint32_t& v : triangle) {
      if (number[v] == UINT32_MAX) {
        number[v] = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[v]);
      }
      v = number[v];
    }
    part.triangles.push_back(triangle);
  }
  return part;
}

/// All lengths of a mould, mm.
struct Sizes {
  double sprue, vent, cell;
  double wall;  ///< of the block around the cavity
  double head;  ///< of metal above the casting

  Sizes(const Vec3& extent, double peg) {
    const double longest = extent.maxCoeff();
    sprue = std::clamp(longest / 12, 1.5, 5.0);
    vent = std::clamp(sprue / 3, 0.6, 1.2);
    cell = std::min(longest / 100, vent / 1.5);
    wall = std::max(3.0, 5 * peg);  // a peg's hole with half its radius around it, on either side
    head = std::max(wall, 2 * sprue);
  }
};

std::vector<Channel> channels_of(const std::vector<Vec3>& places, const Sizes& sizes, double top) {
  std::vector<Channel> channels;
  for (const Vec3& at : places) {
    const double radius = channels.empty() ? sizes.sprue : sizes.vent;
    channels.push_back({at - radius * Vec3::UnitZ(), radius, top});
  }
  return channels;
}

/// A block with an open cavity, in one piece. @param metal  ends above the top
MaterialPart block_around(const TriangleMesh& metal, const Sizes& sizes, double top) {
  Box box = bounding_box(metal);
  const double x0 = box.lo[0] - sizes.wall, x1 = box.hi[0] + sizes.wall, y0 = box.lo[1] - sizes.wall,
               y1 = box.hi[1] + sizes.wall;
  const TriangleMesh around =
      prism({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, box.lo[2] - sizes.wall, box.hi[2] + sizes.wall);
  TriangleMesh cavity = metal;
  for (Triangle& t : cavity.triangles) std::swap(t[1], t[2]);
  // Cut below where the channels end, they are open.
  const Cut lid{Vec3::UnitZ(), top, 0};
  return cut_part({"mould", 1, {around, cavity}}, std::span(&lid, 1))[1];
}

double holes_of(const std::vector<MaterialPart>& parts, const Pegs& pegs) {
  double sum = 0;
  for (const MaterialPart& part : parts)
    if (part.name.starts_with("peg"))
      sum += volume_of(prism(circle({0, 0}, pegs.radius, Pegs::sides), 0, 2 * pegs.depth()));
  return sum;
}

}  // namespace

std::vector<TriangleMesh> castings_of(const MaterialPart& part, double least) {
  const TriangleMesh mesh = joined(part.surfaces, part.name);
  std::vector<TriangleMesh> castings;
  for (const Shell& shell : shells(mesh)) {
    if (std::abs(shell.volume) < least) continue;
    if (shell.volume < 0)
      throw InputError(
          fmt::format("--mould: the {} encloses a void of {:.3g} mm^3, which two halves cannot leave free; "
                      "expected a solid without one, as by a heavier filling in place of the void "
                      "(--void-density)",
                      part.name, -shell.volume));
    castings.push_back(part_of(mesh, shell));
  }
  return castings;
}

Mould mould_of(const TriangleMesh& casting) {
  constexpr Pegs pegs{1.5};
  Mould mould;
  mould.parting = least_undercut(casting);
  const Sizes sizes(bounding_box(in_frame(casting, axis_to_z(mould.parting.normal))).extent(), pegs.radius);
  const double least = std::max(0.5, sizes.vent);
  std::vector<Vec3> places;
  for (const double sign : {1.0, -1.0}) {
    std::vector<Vec3> found = high_places(in_frame(casting, axis_to_z(sign * mould.parting.normal)), least);
    if (!places.empty() && found.size() >= places.size()) continue;
    places = std::move(found);
    if (sign < 0) mould.parting.normal *= -1, mould.parting.offset *= -1;
  }
  const TriangleMesh upright = in_frame(casting, axis_to_z(mould.parting.normal));
  const double top = bounding_box(upright).hi[2] + sizes.head;
  const std::vector<Channel> channels = channels_of(places, sizes, top + 3 * sizes.cell);
  const MaterialPart block = block_around(poured(upright, channels, sizes.cell), sizes, top);
  const Cut halves{Vec3::UnitZ(), mould.parting.offset, 0};
  mould.parts = cut_part(block, std::span(&halves, 1), pegs);
  // Printed with the cavity open upwards, so that no support goes into it.
  mould.parts[0].down = Vec3::UnitZ(), mould.parts[1].down = -Vec3::UnitZ();
  lay_flat(mould.parts);

  mould.sprue_radius = sizes.sprue, mould.vent_radius = sizes.vent;
  mould.vents = channels.size() - 1;
  mould.casting = volume_of(casting);
  mould.cavity = volume_of(poured(upright, {}, sizes.cell));
  const Vec3 size = bounding_box(block.surfaces.front()).extent();
  mould.metal = size.prod() - holes_of(mould.parts, pegs);
  for (std::size_t half : {0, 1}) mould.metal -= volume_of(mould.parts[half].surfaces.front());
  return mould;
}

}  // namespace kreisel::core
