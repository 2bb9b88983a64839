#include "body/stem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "body/imprint.hpp"
#include "error.hpp"
#include "geometry/moved.hpp"
#include "geometry/predicates.hpp"

namespace kreisel::core {
namespace {

using Number = std::uint32_t;
constexpr int stem_sides = 32;  // its section is 0.6 % less than a circle's

[[noreturn]] void refuse_stem(const Stem& stem, const char* why) {
  throw InputError(
      fmt::format("a stem of {:.3g} mm radius: {}; expected another --axis or --contact, or a thinner --stem",
                  stem.radius, why));
}

/// @param phase  of a side, 0 to 1
Polygon outline_of(double radius, double phase) {
  Polygon polygon = circle(Vec2::Zero(), radius, stem_sides);
  const Eigen::Rotation2Dd turn(2 * std::numbers::pi / stem_sides * phase);
  for (Vec2& p : polygon) p = turn * p;
  return polygon;
}

/// Height of a triangle above the origin, where it covers it.
std::optional<double> height_at_axis(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
  const Vec2 p = Vec2::Zero(), u = a.head<2>(), v = b.head<2>(), w = c.head<2>();
  const bool left = orient2d(u, v, w) > 0;
  if (orient2d(u, v, w) == 0 || !(left ? in_triangle(p, u, v, w) : in_triangle(p, u, w, v)))
    return std::nullopt;
  const Vec3 n = (b - a).cross(c - a);
  return a[2] + (n[0] * a[0] + n[1] * a[1]) / n[2];
}

using Edge = std::pair<Number, Number>;
std::uint64_t key_of(Edge e) { return std::uint64_t{e.first} << 32 | e.second; }

/// What the peg covers: triangles that hang together around the place where the axis enters the solid, and
/// their rim, edge after edge as they have it.
struct Cover {
  std::vector<bool> covered;  ///< by triangle of the imprinted mesh
  std::vector<Number> rim;
};

class Covering {
 public:
  Covering(const Imprint& drawn, const Stem& stem) : mesh_(drawn.mesh), stem_(stem) {
    for (const Number t : drawn.inside)
      for (std::size_t k = 0; k < 3; ++k) owner_[key_of(edge(t, k))] = t;
    cover_.covered.assign(mesh_.triangles.size(), false);
    flood(first_met(drawn.inside));
    follow_rim();
    require_clear(drawn.inside);
  }
  [[nodiscard]] const Cover& cover() const { return cover_; }

 private:
  [[nodiscard]] Edge edge(Number t, std::size_t k) const {
    return {mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]};
  }

  [[nodiscard]] Number first_met(const std::vector<Number>& inside) const {
    std::optional<Number> first;
    double lowest = std::numeric_limits<double>::infinity();
    for (const Number t : inside)
      if (const auto z = height_at_axis(mesh_, mesh_.triangles[t]); z && *z < lowest) lowest = *z, first = t;
    if (!first) refuse_stem(stem_, "the axis does not meet the body");
    return *first;
  }

  void flood(Number first) {
    patch_ = {first};
    cover_.covered[first] = true;
    for (std::size_t i = 0; i < patch_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge e = edge(patch_[i], k);
        const auto twin = owner_.find(key_of({e.second, e.first}));
        if (twin == owner_.end()) {
          if (!after_.emplace(e.first, e.second).second)
            refuse_stem(stem_, "the part of the surface that it would cover touches itself");
        } else if (!cover_.covered[twin->second]) {
          cover_.covered[twin->second] = true;
          patch_.push_back(twin->second);
        }
      }
  }

  /// One ring around the axis, clockwise seen from above, at every place a single height.
  void follow_rim() {
    if (after_.empty()) refuse_stem(stem_, "the body is thinner there than the stem");
    const Number start = after_.begin()->first;
    Number at = start;
    double turned = 0;
    do {
      const auto next = after_.find(at);
      if (next == after_.end() || cover_.rim.size() == after_.size())
        refuse_stem(stem_, "the part of the surface that it would cover is in several pieces");
      cover_.rim.push_back(at);
      const Vec2 u = mesh_.vertices[at].head<2>(), v = mesh_.vertices[next->second].head<2>();
      const double angle = std::atan2(cross(u, v), u.dot(v));
      if (!(angle < 0)) refuse_stem(stem_, "the surface overhangs where the stem would begin");
      turned += angle;
      at = next->second;
    } while (at != start);
    const bool once = std::abs(turned + 2 * std::numbers::pi) < 1e-3;
    if (cover_.rim.size() != after_.size() || !once)
      refuse_stem(stem_, "the part of the surface that it would cover is in several pieces");
  }

  /// Nothing else of the surface is within the peg.
  void require_clear(const std::vector<Number>& inside) const {
    double top = -std::numeric_limits<double>::infinity();
    for (const Number v : cover_.rim) top = std::max(top, mesh_.vertices[v][2]);
    for (const Number t : inside)
      if (!cover_.covered[t])
        for (const Number v : mesh_.triangles[t])
          if (mesh_.vertices[v][2] < top) refuse_stem(stem_, "another part of the body is in its way");
  }

  const TriangleMesh& mesh_;
  const Stem& stem_;
  std::unordered_map<std::uint64_t, Number> owner_;
  std::unordered_map<Number, Number> after_;
  std::vector<Number> patch_;
  Cover cover_;
};

/// The surface without what is covered, with the peg's side, its shoulder and its cone.
Stemmed joined(const TriangleMesh& mesh, const Cover& cover, const Stem& stem, double ring) {
  Stemmed result;
  TriangleMesh& out = result.mesh;
  out.vertices = mesh.vertices;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!cover.covered[t]) out.triangles.push_back(mesh.triangles[t]);
  const std::size_t n = cover.rim.size();
  std::vector<Number> above = cover.rim;
  const auto band = [&](double scale) {
    const auto first = static_cast<Number>(out.vertices.size());
    for (const Number v : cover.rim)
      out.vertices.emplace_back(scale * mesh.vertices[v][0], scale * mesh.vertices[v][1], ring);
    for (std::size_t i = 0; i < n; ++i) {
      const auto j = (i + 1) % n;
      const Number u = first + static_cast<Number>(i), w = first + static_cast<Number>(j);
      out.triangles.push_back({above[i], above[j], w});
      out.triangles.push_back({above[i], w, u});
    }
    for (std::size_t i = 0; i < n; ++i) above[i] = first + static_cast<Number>(i);
  };
  band(1);
  if (stem.tip_radius < stem.radius) band(stem.tip_radius / stem.radius);
  result.point = ring - stem.tip_height;
  const auto apex = static_cast<Number>(out.vertices.size());
  out.vertices.emplace_back(0, 0, result.point);
  for (std::size_t i = 0; i < n; ++i) out.triangles.push_back({above[i], above[(i + 1) % n], apex});
  std::vector<Number> all(out.triangles.size());
  for (Number i = 0; i < all.size(); ++i) all[i] = i;
  out = part_of(out, all);  // without the vertices that nobody uses any more
  return result;
}

}  // namespace

std::optional<Stem> stem_of(const StemSpec& spec) {
  for (const auto& [value, option] : {std::pair{spec.radius, "--stem"}, std::pair{spec.tip_radius, "--tip"},
                                      std::pair{spec.tip_height, "--tip"}})
    if (value && (!(*value > 0) || !std::isfinite(*value)))
      throw InputError(fmt::format("{} {} mm; expected > 0", option, *value));
  if (!spec.wanted()) return std::nullopt;
  Stem stem;
  stem.radius = spec.radius ? *spec.radius : *spec.tip_radius;
  stem.tip_radius = spec.tip_radius.value_or(stem.radius);
  stem.tip_height = spec.tip_height.value_or(stem.tip_radius);
  if (stem.tip_radius > stem.radius)
    throw InputError(fmt::format("--tip {} mm on a stem of {} mm; expected a tip that is no wider",
                                 stem.tip_radius, stem.radius));
  return stem;
}

Stemmed with_stem(const TriangleMesh& solid, const Stem& stem) {
  const Box box = bounding_box(solid);
  // Sides that pass a vertex nearly would cut off slivers that a file of single precision cannot tell from
  // nothing: of some phases of the polygon, the first that leaves no edge that short, else the best.
  constexpr int phases = 12;
  const double short_edge = 1e-5 * box.extent().maxCoeff();
  Imprint best;
  for (int i = 0; i < phases && best.shortest < short_edge; ++i) {
    Imprint drawn = imprint(solid, outline_of(stem.radius, (i + 0.37) / phases));
    if (drawn.shortest > best.shortest) best = std::move(drawn);
  }
  if (best.inside.empty()) refuse_stem(stem, "the axis does not meet the body");
  // A little below the lowest point, so that a flat bottom leaves the peg a side.
  return joined(best.mesh, Covering(best, stem).cover(), stem, box.lo[2] - 0.05 * stem.radius);
}

}  // namespace kreisel::core
