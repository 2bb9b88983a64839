#include "body/dry_space.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "disjoint_sets.hpp"
#include "geometry/polygon.hpp"

namespace kreisel::core {
namespace {

constexpr std::uint32_t nowhere = ~0u;

/// A closed line in which the surface meets the plane, material to its left.
struct SectionLoop {
  Polygon points;
  std::uint32_t low = nowhere;  ///< a vertex of the surface below that ends in it
};

/// Where the surface passes the plane, from edge to edge.
std::vector<SectionLoop> loops_at(const TriangleMesh& mesh, double level) {
  const auto below = [&](std::uint32_t v) { return mesh.vertices[v][2] <= level; };
  const auto cut = [&](std::uint32_t low, std::uint32_t high) -> Vec2 {
    const Vec3 &a = mesh.vertices[low], &b = mesh.vertices[high];
    return (a + (level - a[2]) / (b[2] - a[2]) * (b - a)).head<2>();
  };
  struct Step {
    std::uint64_t to;
    Vec2 from;
    std::uint32_t low;
  };
  std::unordered_map<std::uint64_t, Step> onward;
  for (const Triangle& t : mesh.triangles) {
    const int under = below(t[0]) + below(t[1]) + below(t[2]);
    if (under == 0 || under == 3) continue;
    Step step{};
    std::uint64_t from = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (below(a) == below(b)) continue;
      const std::uint64_t edge = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
      // The surface below runs along the plane from where it leaves to where it enters, the section beside
      // it the other way.
      if (below(a)) {
        step.to = edge;
        step.low = a;
      } else {
        from = edge;
        step.from = cut(b, a);
      }
    }
    onward.emplace(from, step);
  }
  std::vector<SectionLoop> found;
  while (!onward.empty()) {
    SectionLoop loop;
    for (auto next = onward.begin(); next != onward.end();) {
      const Step step = next->second;
      loop.points.push_back(step.from);
      loop.low = step.low;
      onward.erase(next);
      next = onward.find(step.to);
    }
    found.push_back(std::move(loop));
  }
  return found;
}

/// Vertices joined along edges that keep to one side.
template <class Keeps>
DisjointSets joined(const TriangleMesh& mesh, const Keeps& keeps) {
  DisjointSets pieces(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (const std::uint32_t a = t[k], b = t[(k + 1) % 3]; a < b && keeps(a) && keeps(b)) pieces.join(a, b);
  return pieces;
}

/// Six times the volume of a triangle's cone to the origin.
double cone(const TriangleMesh& mesh, const Triangle& t) {
  return mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
}

/// For each loop the region without material that it bounds: the number of the loop around that, or none
/// where it is the water that has no end.
std::vector<std::uint32_t> regions_beside(const std::vector<SectionLoop>& loops) {
  std::vector<std::uint32_t> region(loops.size(), nowhere);
  std::vector<double> hollow;  // areas, of those around hollows positive
  for (const SectionLoop& loop : loops) hollow.push_back(-area(loop.points));
  for (std::uint32_t i = 0; i < loops.size(); ++i) {
    if (hollow[i] >= 0) {
      region[i] = i;
      continue;
    }
    double least = std::numeric_limits<double>::infinity();  // the smallest hollow around it
    for (std::uint32_t j = 0; j < loops.size(); ++j) {
      if (hollow[j] <= 0 || hollow[j] >= least || !contains(loops[j].points, loops[i].points[0])) continue;
      least = hollow[j];
      region[i] = j;
    }
  }
  return region;
}

}  // namespace

bool LazyCavities::in(const TriangleMesh& mesh) const {
  std::call_once(made_->once, [&] {
    DisjointSets shells = joined(mesh, [](std::uint32_t) { return true; });
    std::vector<double> volume(mesh.vertices.size(), 0);
    for (const Triangle& t : mesh.triangles) volume[shells.find(t[0])] += cone(mesh, t);
    made_->any = std::ranges::any_of(volume, [](double v) { return v < 0; });
  });
  return made_->any;
}

std::vector<char> DrySpace::vertices(double level) const {
  const std::vector<SectionLoop> loops = loops_at(mesh_, level);
  const bool hollow = std::ranges::any_of(loops, [](const SectionLoop& l) { return area(l.points) <= 0; });
  if (!hollow && !cavities_.in(mesh_)) return {};
  const auto below = [&](std::uint32_t v) { return mesh_.vertices[v][2] <= level; };
  DisjointSets pieces = joined(mesh_, below);
  const std::vector<std::uint32_t> region = regions_beside(loops);
  // Regions, and pieces of surface by what they end in; the last is the water outside.
  const auto outside = std::uint32_t(loops.size());
  DisjointSets waters(loops.size() + 1);
  std::vector<std::uint32_t> water_of(mesh_.vertices.size(), nowhere);  // by piece
  for (std::uint32_t i = 0; i < loops.size(); ++i) {
    const std::uint32_t beside = region[i] == nowhere ? outside : region[i];
    std::uint32_t& water = water_of[pieces.find(loops[i].low)];
    if (water == nowhere) water = beside;
    waters.join(water, beside);
  }
  // What ends nowhere is a cavity where it faces inward, else material around which all is wet.
  std::vector<double> volume(mesh_.vertices.size(), 0);
  for (const Triangle& t : mesh_.triangles)
    if (below(t[0]) && below(t[1]) && below(t[2]))
      if (const std::uint32_t piece = pieces.find(t[0]); water_of[piece] == nowhere)
        volume[piece] += cone(mesh_, t);
  std::vector<char> vertices(mesh_.vertices.size(), 0);
  bool any = false;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    if (!below(v)) continue;
    const std::uint32_t piece = pieces.find(v), water = water_of[piece];
    vertices[v] = water == nowhere ? volume[piece] < 0 : waters.find(water) != waters.find(outside);
    any = any || vertices[v];
  }
  if (!any) vertices.clear();
  return vertices;
}

}  // namespace kreisel::core
