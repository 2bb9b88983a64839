#include "fabricate/voids.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "geometry/moved.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/solid/components.hpp"

namespace kreisel::core {
namespace {

/// Where a void begins and ends along a direction.
struct Extent {
  double low, high;

  [[nodiscard]] bool holds(double at) const { return low < at && at < high; }
};

Extent extent_of(const TriangleMesh& mesh, const Shell& shell, const Vec3& direction) {
  Extent e{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const std::uint32_t t : shell.triangles)
    for (const std::uint32_t v : mesh.triangles[t]) {
      const double at = direction.dot(mesh.vertices[v]);
      e.low = std::min(e.low, at);
      e.high = std::max(e.high, at);
    }
  return e;
}

struct Stab {
  std::size_t count = 0;
  double offset = 0, room = 0;  ///< room: how far the plane could move and still run through all of them

  [[nodiscard]] bool better_than(const Stab& other) const {
    return count != other.count ? count > other.count : room > other.room;
  }
};

/// The place that lies in most of the extents. A void hangs together, so a plane between its ends meets it.
Stab deepest(const std::vector<Extent>& extents) {
  Stab best;
  for (const Extent& e : extents) {  // where most overlap, one of them begins
    Stab here;
    double end = std::numeric_limits<double>::infinity();
    for (const Extent& other : extents)
      if (other.low <= e.low && e.low < other.high) {
        ++here.count;
        end = std::min(end, other.high);
      }
    // The next to begin would only make it more, and then is a candidate itself.
    here.room = end - e.low;
    here.offset = (e.low + end) / 2;
    if (here.better_than(best)) best = here;
  }
  return best;
}

std::vector<Cut> cuts_of(const TriangleMesh& mesh, const std::vector<Shell>& voids,
                         std::span<const Vec3> directions) {
  struct Across {
    Vec3 normal;
    std::vector<Extent> closed;  ///< of the voids that no cut opens yet, in their order
  };
  std::vector<Across> all;
  for (const Vec3& direction : directions) {
    Across across{direction.normalized(), {}};
    for (const Shell& shell : voids) across.closed.push_back(extent_of(mesh, shell, across.normal));
    all.push_back(std::move(across));
  }
  std::vector<Cut> cuts;
  while (!all.empty() && !all.front().closed.empty()) {
    Stab best;
    const Across* where = nullptr;
    for (const Across& across : all)
      if (const Stab stab = deepest(across.closed); stab.better_than(best)) {
        best = stab;
        where = &across;
      }
    if (!where) break;  // what is left has no volume
    cuts.push_back({{where->normal, best.offset}, best.count});
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < where->closed.size(); ++i)
      if (!where->closed[i].holds(best.offset)) left.push_back(i);
    for (Across& across : all) {
      std::vector<Extent> kept;
      for (const std::size_t i : left) kept.push_back(across.closed[i]);
      across.closed = std::move(kept);
    }
  }
  return cuts;
}

/// Four digits, and hundredths of a millimetre however far from the origin.
std::string place_text(double mm) {
  return std::abs(mm) < 1e3 ? fmt::format("{:.4g}", mm) : fmt::format("{:.2f}", mm);
}

std::string list_of(const std::vector<double>& volumes) {
  constexpr std::size_t most = 3;
  std::vector<std::string> words;
  for (std::size_t i = 0; i < volumes.size() && i < most; ++i)
    words.push_back(fmt::format("{:.4g}", volumes[i]));
  if (volumes.size() > most) words.push_back("less");
  if (words.size() == 1) return words.front();
  const std::string last = words.back();
  words.pop_back();
  return fmt::format("{} and {}", fmt::join(words, ", "), last);
}

}  // namespace

std::vector<Vec3> cut_directions(const Body& body) {
  const PrincipalAxes principal(inertia_about_centre(body.solid));
  std::vector<Vec3> directions = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (int k = 0; k < 3; ++k)
    directions.emplace_back(body.frame.rotation.transpose() * principal.axes.col(k));
  return directions;
}

Voids find_voids(const std::vector<TriangleMesh>& parts, std::span<const Vec3> directions) {
  const TriangleMesh mesh = joined(parts, "the part");
  const std::vector<Shell> all = shells(mesh);
  const std::vector<std::vector<std::uint32_t>> enclosing = enclosing_shells(mesh, all);
  // A piece is what its shell encloses less what the shells directly inside enclose.
  std::vector<double> volume(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    volume[i] += std::abs(all[i].volume);
    for (const std::uint32_t j : enclosing[i])
      if (enclosing[j].size() + 1 == enclosing[i].size()) volume[j] -= std::abs(all[i].volume);
  }
  Voids voids;
  std::vector<Shell> closed;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (enclosing[i].size() % 2 == 1) {
      voids.pieces.push_back(volume[i]);
      closed.push_back(all[i]);
    } else if (!enclosing[i].empty()) {
      voids.islands.push_back(volume[i]);
    }
  }
  std::ranges::sort(voids.pieces, std::ranges::greater());
  std::ranges::sort(voids.islands, std::ranges::greater());
  voids.cuts = cuts_of(mesh, closed, directions);
  return voids;
}

TriangleMesh without_small_shells(const TriangleMesh& cavity, double least_volume) {
  const std::vector<Shell> all = shells(cavity);
  const auto small = [&](const Shell& shell) { return std::abs(shell.volume) < least_volume; };
  if (std::ranges::none_of(all, small)) return cavity;
  std::vector<std::uint32_t> kept;
  for (const Shell& shell : all)
    if (!small(shell)) kept.insert(kept.end(), shell.triangles.begin(), shell.triangles.end());
  return part_of(cavity, kept);
}

std::string Voids::text() const {
  if (pieces.empty()) return "none";
  const auto shown = [](double component) { return std::round(1e3 * component) / 1e3 + 0.0; };  // no -0
  std::vector<std::string> planes;
  for (const Cut& cut : cuts)
    planes.push_back(fmt::format("{},{},{} . x = {}", shown(cut.normal[0]), shown(cut.normal[1]),
                                 shown(cut.normal[2]), place_text(cut.offset)));
  return fmt::format("{} void{} of {} mm^3, opened by {} planar cut{}: {}", pieces.size(),
                     pieces.size() == 1 ? "" : "s", list_of(pieces), cuts.size(), cuts.size() == 1 ? "" : "s",
                     fmt::join(planes, "; "));
}

}  // namespace kreisel::core
