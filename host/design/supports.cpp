#include "design/supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "error.hpp"
#include "geometry/rotation.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/query/surface_rays.hpp"
#include "print/gcode/remark.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

double supports_of(const Print& print) {
  return print.volume([](const PrintGroup& group) { return is_support(group.type); });
}

/// Of a mesh: the middles of some of its triangles, spread over all of them, that stand for its whole area.
struct Spot {
  Vec3 at, normal;
  double area;
};

std::vector<Spot> spots_of(const TriangleMesh& mesh) {
  constexpr std::size_t most = 4000;
  const std::size_t step = std::max<std::size_t>(1, mesh.triangles.size() / most);
  std::vector<Spot> spots;
  double all = 0, taken = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    const Vec3 cross = (q - p).cross(r - p);
    const double area = cross.norm() / 2;
    all += area;
    if (t % step != 0 || !(area > 0)) continue;
    taken += area;
    spots.push_back({(p + q + r) / 3, cross / (2 * area), area});
  }
  for (Spot& spot : spots) spot.area *= all / taken;
  return spots;
}

class Ceilings {
 public:
  explicit Ceilings(const TriangleMesh& surface) : mesh_(surface), spots_(spots_of(surface)), rays_(surface) {
    size_ = bounding_box(surface).extent().norm();
  }
  [[nodiscard]] double below(const Vec3& up) const {
    stop_here();
    double bed = std::numeric_limits<double>::infinity();
    for (const Vec3& v : mesh_.vertices) bed = std::min(bed, up.dot(v));
    double volume = 0;
    for (const Spot& spot : spots_) {
      const double down = -spot.normal.dot(up);
      if (down < std::numbers::sqrt2 / 2) continue;
      const auto hit = rays_.first(spot.at, -up, 1e-5 * size_, 2 * size_);
      volume += spot.area * down * (hit ? hit->distance : up.dot(spot.at) - bed);
    }
    return volume;
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<Spot> spots_;
  SurfaceRays rays_;
  double size_;
};

}  // namespace

std::optional<Supports> measure_supports(const MeshSlicer& slice, const TriangleMesh& outer,
                                         const TriangleMesh& cavity, const Vec3& up, const Control& control) {
  const auto everywhere = slice.with_supports_everywhere();
  if (!everywhere) return std::nullopt;
  const auto of = [&](const TriangleMesh& mesh) {
    return supports_of((*everywhere)(mesh, up, 1.0, control).print);
  };
  if (cavity.triangles.empty()) return Supports{0, of(outer)};
  const double hollow = of(joined({outer, cavity}, "the part")), solid = of(outer);
  return Supports{std::max(hollow - solid, 0.0), hollow};
}

std::optional<Supports> measure_supports(const MeshSlicer& slice, const std::vector<PrintPiece>& pieces,
                                         const Control& control) {
  std::optional<Supports> all;
  for (const PrintPiece& piece : pieces) {
    if (piece.cavity.triangles.empty()) continue;
    const auto one = measure_supports(slice, piece.outer, piece.cavity, piece.up, control);
    if (!one) return std::nullopt;
    if (!all) all.emplace();
    all->in_voids += one->in_voids;
    all->in_all += one->in_all;
  }
  return all;
}

double below_ceilings(const TriangleMesh& surface, const Vec3& up) { return Ceilings(surface).below(up); }

FoundUp find_up(const MeshSlicer& slice, const TriangleMesh& outer, const TriangleMesh& cavity,
                const Vec3& usual, const std::function<bool(const Vec3&)>& fits, const Control& control) {
  constexpr int spread = 300;
  constexpr std::size_t most_sliced = 4;
  constexpr double apart = 0.94;  // the cosine of 20 degrees
  const StopScope scope(control.stop);
  control.tell("look for the way up that needs least support");
  const bool hollow = !cavity.triangles.empty();
  const Ceilings ceilings(hollow ? cavity : outer), beside(outer);
  std::vector<std::pair<double, Vec3>> ranked;
  std::vector<Vec3> directions = sphere_directions(spread);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) directions.emplace_back(sign * Vec3::Unit(axis));
  std::erase_if(directions, [&](const Vec3& up) { return !fits(up); });
  // Supports that can be taken off decide where those in voids do not.
  for (const Vec3& up : directions)
    ranked.emplace_back(ceilings.below(up) + (hollow ? 1e-3 * beside.below(up) : 0), up);
  std::ranges::stable_sort(ranked, {}, &std::pair<double, Vec3>::first);
  std::vector<Vec3> chosen;
  if (fits(usual)) chosen.push_back(usual.normalized());
  for (const auto& [volume, up] : ranked) {
    if (chosen.size() > most_sliced) break;
    if (std::ranges::all_of(chosen, [&](const Vec3& other) { return other.dot(up) < apart; }))
      chosen.push_back(up);
  }
  if (chosen.empty())
    throw InputError(
        "--print-up auto of a part that is too large for the printer whichever way up, expected a smaller "
        "--size");
  FoundUp found{usual, static_cast<int>(directions.size()), {}};
  const auto worse = [](const Supports& a, const Supports& b) {
    constexpr double alike = 1;  // mm^3
    return std::abs(a.in_voids - b.in_voids) > alike ? a.in_voids > b.in_voids : a.in_all > b.in_all;
  };
  std::optional<Supports> best;
  for (const Vec3& up : chosen) {
    const auto supports = measure_supports(slice, outer, cavity, up, control);
    if (!supports)
      throw InputError(
          "--print-up auto by a command, expected a slicer that is known: prusa-slicer, cura-engine");
    found.sliced.push_back({up, *supports});
    if (best && !worse(*best, *supports)) continue;
    best = supports;
    found.up = up;
  }
  return found;
}

}  // namespace kreisel::core
