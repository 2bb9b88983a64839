#include "mesh/make/flip_flat.hpp"

#include <optional>
#include <tuple>
#include <unordered_map>

#include "geometry/predicates.hpp"

namespace kreisel::core {
namespace {

/// Triangles by their sides; a side that two triangles run the same way belongs to none.
class DirectedSides {
 public:
  explicit DirectedSides(const TriangleMesh& mesh) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [entry, fresh] =
            owner_.try_emplace(key(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]), t);
        if (!fresh) entry->second = none;
      }
  }
  [[nodiscard]] bool has(std::uint32_t from, std::uint32_t to) const {
    return owner_.count(key(from, to)) > 0;
  }
  [[nodiscard]] std::optional<std::uint32_t> find(std::uint32_t from, std::uint32_t to) const {
    const auto found = owner_.find(key(from, to));
    if (found == owner_.end() || found->second == none) return std::nullopt;
    return found->second;
  }
  void set(std::uint32_t from, std::uint32_t to, std::uint32_t triangle) { owner_[key(from, to)] = triangle; }
  void erase(std::uint32_t from, std::uint32_t to) { owner_.erase(key(from, to)); }

 private:
  static constexpr std::uint32_t none = ~0u;
  static std::uint64_t key(std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32 | to; }
  std::unordered_map<std::uint64_t, std::uint32_t> owner_;
};

bool flat(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return projection_axis(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) < 0;
}

/// Of three points on one line: is b strictly between a and c?
bool strictly_between(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto order = [](const Vec3& p) { return std::make_tuple(p.x(), p.y(), p.z()); };
  return (order(a) < order(b) && order(b) < order(c)) || (order(c) < order(b) && order(b) < order(a));
}

bool flip(TriangleMesh& mesh, DirectedSides& sides, std::uint32_t triangle) {
  for (std::size_t k = 0; k < 3; ++k) {
    Triangle& t = mesh.triangles[triangle];
    const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
    if (!strictly_between(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c])) continue;
    const auto across = sides.find(a, c);
    if (!across || !sides.find(c, a) || flat(mesh, *across)) return false;
    Triangle& n = mesh.triangles[*across];
    const std::uint32_t d = n[0] != a && n[0] != c ? n[0] : n[1] != a && n[1] != c ? n[1] : n[2];
    if (sides.has(b, d) || sides.has(d, b)) return false;
    t = {a, b, d};
    n = {b, c, d};
    sides.erase(a, c);
    sides.erase(c, a);
    sides.set(d, a, triangle);
    sides.set(b, d, triangle);
    sides.set(b, c, *across);
    sides.set(d, b, *across);
    return true;
  }
  return false;
}

}  // namespace

std::size_t flip_flat_triangles(TriangleMesh& mesh) {
  std::vector<std::uint32_t> left;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (flat(mesh, t)) left.push_back(t);
  if (left.empty()) return 0;
  DirectedSides sides(mesh);
  std::size_t flipped = 0;
  for (bool progress = true; progress;)  // a flip may give the next flat triangle a neighbour with area
    progress = std::erase_if(left, [&](std::uint32_t t) {
                 const bool done = flip(mesh, sides, t);
                 flipped += done;
                 return done;
               }) > 0;
  return flipped;
}

}  // namespace kreisel::core
