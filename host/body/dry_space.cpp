#include "body/dry_space.hpp"

#include <Eigen/Geometry>
#include <cstdint>
#include <unordered_map>

#include "geometry/polygon.hpp"
#include "mesh/query/sides.hpp"

namespace kreisel::core {
namespace {

constexpr std::uint32_t nowhere = ~0u;

/// A closed line in which the surface meets the plane, material to its left.
struct SectionLoop {
  Polygon points;
  std::uint32_t piece = nowhere;  ///< of the surface below
};

/// The surface at or below the plane in pieces: vertices joined along edges that are below it.
class Below {
 public:
  Below(const TriangleMesh& mesh, double level) : mesh_(mesh), level_(level), pieces_(mesh.vertices.size()) {
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (const std::uint32_t a = t[k], b = t[(k + 1) % 3]; below(a) && below(b)) pieces_.join(a, b);
  }

  [[nodiscard]] bool below(std::uint32_t v) const { return mesh_.vertices[v][2] <= level_; }
  [[nodiscard]] std::uint32_t piece(std::uint32_t v) { return pieces_.find(v); }

  /// From edge to edge that passes the plane.
  [[nodiscard]] std::vector<SectionLoop> loops() {
    struct Step {
      std::uint64_t to;
      Vec2 from;
      std::uint32_t low;
    };
    std::unordered_map<std::uint64_t, Step> onward;
    for (const Triangle& t : mesh_.triangles) {
      Step step{};
      std::uint64_t from = 0;
      bool crosses = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (below(a) == below(b)) continue;
        crosses = true;
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
      if (crosses) onward.emplace(from, step);
    }
    std::vector<SectionLoop> found;
    while (!onward.empty()) {
      SectionLoop loop;
      for (auto next = onward.begin(); next != onward.end();) {
        const Step step = next->second;
        loop.points.push_back(step.from);
        loop.piece = piece(step.low);
        onward.erase(next);
        next = onward.find(step.to);
      }
      found.push_back(std::move(loop));
    }
    return found;
  }

 private:
  [[nodiscard]] Vec2 cut(std::uint32_t low, std::uint32_t high) const {
    const Vec3 &a = mesh_.vertices[low], &b = mesh_.vertices[high];
    return (a + (level_ - a[2]) / (b[2] - a[2]) * (b - a)).head<2>();
  }

  const TriangleMesh& mesh_;
  double level_;
  DisjointSets pieces_;
};

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

std::vector<char> dry_vertices(const TriangleMesh& mesh, double level) {
  Below below(mesh, level);
  const std::vector<SectionLoop> loops = below.loops();
  const std::vector<std::uint32_t> region = regions_beside(loops);
  // Regions, and pieces of surface by what they end in; the last is the water outside.
  const auto outside = std::uint32_t(loops.size());
  DisjointSets waters(loops.size() + 1);
  std::vector<std::uint32_t> water_of(mesh.vertices.size(), nowhere);  // by piece
  for (std::uint32_t i = 0; i < loops.size(); ++i) {
    const std::uint32_t beside = region[i] == nowhere ? outside : region[i];
    std::uint32_t& water = water_of[loops[i].piece];
    if (water == nowhere) water = beside;
    waters.join(water, beside);
  }
  // What ends nowhere is a cavity where it faces inward, else material around which all is wet.
  std::vector<double> volume(mesh.vertices.size(), 0);  // six times that of cones to the origin
  for (const auto& [a, b, c] : mesh.triangles)
    if (below.below(a) && below.below(b) && below.below(c))
      if (const std::uint32_t piece = below.piece(a); water_of[piece] == nowhere)
        volume[piece] += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c]));
  std::vector<char> vertices(mesh.vertices.size(), 0);
  bool any = false;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    if (!below.below(v)) continue;
    const std::uint32_t piece = below.piece(v), water = water_of[piece];
    vertices[v] = water == nowhere ? volume[piece] < 0 : waters.find(water) != waters.find(outside);
    any = any || vertices[v];
  }
  if (!any) vertices.clear();
  return vertices;
}

}  // namespace kreisel::core
