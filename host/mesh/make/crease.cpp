#include "mesh/make/crease.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <utility>

#include "geometry/polygon.hpp"
#include "geometry/triangle_pair.hpp"
#include "parallel.hpp"

namespace kreisel::core {
namespace {

using Face = std::array<Vec3, 3>;

/// How near to the rim of its face a vertex may lie, as a share of the face: nearer ones make slivers.
constexpr double margin = 1e-2;

/// Well inside, by barycentric coordinates?
bool inside(const Face& f, const Vec3& p) {
  const Vec3 n = (f[1] - f[0]).cross(f[2] - f[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = f[(i + 1) % 3], &b = f[(i + 2) % 3];
    if (n.dot((b - a).cross(p - a)) < margin * n.squaredNorm()) return false;
  }
  return true;
}

class Filler {
 public:
  Filler(const std::vector<Vec3>& vertices, std::size_t first_crease)
      : v_(vertices), first_crease_(first_crease) {}

  /// The triangles of a loop, cut along the crease that runs from one of its vertices to another, and else
  /// where it is shortest.
  [[nodiscard]] std::vector<Triangle> operator()(const Loop& loop) const {
    std::vector<std::size_t> creases;
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (loop[i] >= first_crease_) creases.push_back(i);
    std::vector<Triangle> triangles;
    if (creases.size() == 2)
      split(loop, creases[0], creases[1], triangles);
    else
      fill(loop, triangles);
    return triangles;
  }

 private:
  void split(const Loop& loop, std::size_t i, std::size_t j, std::vector<Triangle>& triangles) const {
    const auto at = [&](std::size_t k) { return loop.begin() + static_cast<std::ptrdiff_t>(k); };
    Loop rest(at(j), loop.end());
    rest.insert(rest.end(), loop.begin(), at(i + 1));
    fill(Loop(at(i), at(j + 1)), triangles);
    fill(rest, triangles);
  }
  void fill(const Loop& loop, std::vector<Triangle>& triangles) const {
    const std::size_t n = loop.size();
    if (n == 3) {
      triangles.push_back({loop[0], loop[1], loop[2]});
      return;
    }
    std::optional<std::pair<std::size_t, std::size_t>> shortest;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 2; j < n && j - i < n - 1; ++j)
        if (!in_a_face(loop, i, j) &&
            (!shortest || length(loop[i], loop[j]) < length(loop[shortest->first], loop[shortest->second])))
          shortest = {i, j};
    split(loop, shortest->first, shortest->second, triangles);
  }
  /// Whether between the two there is only the crease's vertex of the face that both lie in: a triangle of
  /// these three would lie in the face, and the tetrahedron beyond have the same.
  [[nodiscard]] bool in_a_face(const Loop& loop, std::size_t i, std::size_t j) const {
    const std::size_t n = loop.size();
    const auto crease = [&](std::size_t k) { return loop[k % n] >= first_crease_; };
    if (crease(i) || crease(j)) return false;
    return (j == i + 2 && crease(i + 1)) || (i + n == j + 2 && crease(j + 1));
  }
  [[nodiscard]] double length(std::uint32_t a, std::uint32_t b) const {
    return (v_[a] - v_[b]).squaredNorm();
  }

  const std::vector<Vec3>& v_;
  std::size_t first_crease_;
};

/// No slivers, and none runs through another.
bool sound(const std::vector<Triangle>& triangles, const std::vector<Vec3>& v) {
  std::vector<NumberedTriangle> all;
  for (const Triangle& t : triangles) {
    const Vec3 &a = v[t[0]], &b = v[t[1]], &c = v[t[2]];
    const double longest = std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
    if ((b - a).cross(c - a).norm() < margin * margin * longest) return false;
    all.push_back({t, {a, b, c}});
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (intersect_improperly(all[i], all[j])) return false;
  return true;
}

}  // namespace

void add_creased(TriangleMesh& mesh, const std::vector<CreasedLoop>& loops,
                 const std::vector<std::uint8_t>& second,
                 const std::function<Face(std::uint32_t, std::uint32_t)>& face_of,
                 const std::function<std::optional<Vec3>(const Face& face, const Vec3&, const Vec3&)>& meet) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> faces;  // vertex of the first piece, of the second
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> number;
  const auto face_between = [&](std::uint32_t a, std::uint32_t b) {
    return second[a] ? std::pair(b, a) : std::pair(a, b);
  };
  for (const CreasedLoop& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      if (second[a] != second[b] && number.try_emplace(face_between(a, b), faces.size()).second)
        faces.push_back(face_between(a, b));
    }

  const std::size_t first = mesh.vertices.size();
  std::vector<Vec3> vertices = mesh.vertices;
  vertices.resize(first + faces.size());
  std::vector<std::uint8_t> used(faces.size());
  parallel_for(faces.size(), [&](std::size_t i) {
    const auto [a, b] = faces[i];
    const Face face = face_of(a, b);
    const std::optional<Vec3> at = meet(face, mesh.vertices[a], mesh.vertices[b]);
    used[i] = at && inside(face, *at);
    if (used[i]) vertices[first + i] = *at;
  });

  const Filler fill(vertices, first);
  const auto with_creases = [&](const CreasedLoop& loop) {
    Loop all;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      all.push_back(a);
      if (second[a] == second[b]) continue;
      if (const std::size_t f = number.at(face_between(a, b)); used[f])
        all.push_back(static_cast<std::uint32_t>(first + f));
    }
    return all;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (const CreasedLoop& loop : loops) {
      const Loop all = with_creases(loop);
      if (all.size() == loop.size() || sound(fill(all), vertices)) continue;
      changed = true;
      for (const std::uint32_t vertex : all)
        if (vertex >= first) used[vertex - first] = false;
    }
  }

  std::vector<std::uint32_t> place(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (used[f]) {
      place[f] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(vertices[first + f]);
    }
  for (const CreasedLoop& loop : loops)
    for (Triangle t : fill(with_creases(loop))) {
      for (std::uint32_t& vertex : t)
        if (vertex >= first) vertex = place[vertex - first];
      mesh.triangles.push_back(t);
    }
}

}  // namespace kreisel::core
