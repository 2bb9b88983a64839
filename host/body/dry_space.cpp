#include "body/dry_space.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "disjoint_sets.hpp"
#include "geometry/polygon.hpp"

namespace kreisel::core {
namespace {

constexpr std::uint32_t nowhere = ~0u;

/// A closed line in which the surface meets the plane, material to its left.
struct SectionLoop {
  Polygon points;
  std::uint32_t low;  ///< a vertex right below it
};

/// From edge to edge that passes the plane.
std::vector<SectionLoop> section_loops(const TriangleMesh& mesh, double level) {
  struct Step {
    std::uint64_t to;
    Vec2 from;
    std::uint32_t low;
  };
  const auto below = [&](std::uint32_t v) { return mesh.vertices[v][2] <= level; };
  const auto cut = [&](std::uint32_t low, std::uint32_t high) -> Vec2 {
    const Vec3 &a = mesh.vertices[low], &b = mesh.vertices[high];
    return (a + (level - a[2]) / (b[2] - a[2]) * (b - a)).head<2>();
  };
  std::unordered_map<std::uint64_t, Step> onward;
  for (const Triangle& t : mesh.triangles) {
    if (below(t[0]) == below(t[1]) && below(t[1]) == below(t[2])) continue;
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
    SectionLoop loop{};
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

/// The surface at or below the plane in pieces: vertices joined along edges that are below it.
class Below {
 public:
  Below(const TriangleMesh& mesh, double level) : mesh_(mesh), level_(level), pieces_(mesh.vertices.size()) {
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (const std::uint32_t a = t[k], b = t[(k + 1) % 3]; contains(a) && contains(b)) pieces_.join(a, b);
  }

  [[nodiscard]] bool contains(std::uint32_t v) const { return mesh_.vertices[v][2] <= level_; }
  [[nodiscard]] std::uint32_t piece(std::uint32_t v) { return pieces_.find(v); }

  /// Of the cones from each piece to the origin, six times; for those that end nowhere what they enclose,
  /// below 0 where they face inward.
  [[nodiscard]] std::vector<double> volumes() {
    std::vector<double> volume(mesh_.vertices.size(), 0);
    for (const auto& [a, b, c] : mesh_.triangles)
      if (contains(a) && contains(b) && contains(c))
        volume[piece(a)] += mesh_.vertices[a].dot(mesh_.vertices[b].cross(mesh_.vertices[c]));
    return volume;
  }

 private:
  const TriangleMesh& mesh_;
  double level_;
  DisjointSets pieces_;
};

/// Does the section at this loop lack what is within it?
bool around_hollow(const SectionLoop& loop) { return area(loop.points) <= 0; }

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

DrySpace::DrySpace(const TriangleMesh& mesh) : mesh_(mesh) {
  const std::vector<double> volumes = Below(mesh, std::numeric_limits<double>::infinity()).volumes();
  cavities_ = std::ranges::any_of(volumes, [](double v) { return v < 0; });
}

std::vector<char> DrySpace::vertices(double level) const {
  const std::vector<SectionLoop> loops = section_loops(mesh_, level);
  if (!cavities_ && std::ranges::none_of(loops, around_hollow)) return {};
  Below below(mesh_, level);
  const std::vector<std::uint32_t> region = regions_beside(loops);
  // Regions, and pieces of surface by what they end in; the last is the water outside.
  const auto outside = std::uint32_t(loops.size());
  DisjointSets waters(loops.size() + 1);
  std::vector<std::uint32_t> water_of(mesh_.vertices.size(), nowhere);  // by piece
  for (std::uint32_t i = 0; i < loops.size(); ++i) {
    const std::uint32_t beside = region[i] == nowhere ? outside : region[i];
    std::uint32_t& water = water_of[below.piece(loops[i].low)];
    if (water == nowhere) water = beside;
    waters.join(water, beside);
  }
  // What ends nowhere is a cavity where it faces inward, else material around which all is wet.
  const std::vector<double> volume = below.volumes();
  std::vector<char> dry(mesh_.vertices.size(), 0);
  bool any = false;
  for (std::uint32_t v = 0; v < dry.size(); ++v) {
    if (!below.contains(v)) continue;
    const std::uint32_t piece = below.piece(v), water = water_of[piece];
    dry[v] = water == nowhere ? volume[piece] < 0 : waters.find(water) != waters.find(outside);
    any = any || dry[v];
  }
  if (!any) dry.clear();
  return dry;
}

}  // namespace kreisel::core
