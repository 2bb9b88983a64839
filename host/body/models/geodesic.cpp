#include "body/models/geodesic.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "body/models/shapes.hpp"

namespace kreisel::core {
namespace {

constexpr int max_frequency = 14000;  // 20 n^2 stays below 2^32

/// (0, +-1, +-phi) and its cyclic shifts, on the unit sphere. Index: 4 * shift + two sign bits.
std::array<Vec3, 12> icosahedron_corners() {
  const double phi = 0.5 * (1.0 + std::sqrt(5.0));
  std::array<Vec3, 12> corners;
  for (int i = 0; i < 12; ++i) {
    const int shift = i / 4;
    Vec3 v = Vec3::Zero();
    v[(shift + 1) % 3] = (i & 1) ? -1.0 : 1.0;
    v[(shift + 2) % 3] = (i & 2) ? -phi : phi;
    corners[std::size_t(i)] = v.normalized();
  }
  return corners;
}

/// Its 20 faces, found as the triples of mutual neighbours, counter-clockwise from outside.
std::vector<Triangle> icosahedron_faces(const std::array<Vec3, 12>& corners) {
  const double neighbour = 0.4;  // cosines between corners are 0.447 (neighbours), -0.447 and -1
  std::vector<Triangle> faces;
  for (std::uint32_t a = 0; a < 12; ++a)
    for (std::uint32_t b = a + 1; b < 12; ++b)
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        const Vec3 &p = corners[a], &q = corners[b], &r = corners[c];
        if (p.dot(q) < neighbour || q.dot(r) < neighbour || r.dot(p) < neighbour) continue;
        faces.push_back(p.dot(q.cross(r)) > 0 ? Triangle{a, b, c} : Triangle{a, c, b});
      }
  return faces;
}

/// Numbers the points of the divided faces so that faces share those on their common edges and corners.
class Numbering {
 public:
  Numbering(const std::array<Vec3, 12>& corners, int frequency, std::vector<Vec3>& vertices)
      : corners_(corners), n_(frequency), vertices_(vertices) {
    vertices_.assign(corners.begin(), corners.end());
  }

  /// Vertex at integer barycentric coordinates (w[0] + w[1] + w[2] = n) of a face.
  std::uint32_t operator()(const Triangle& face, const std::array<int, 3>& w) {
    for (std::size_t k = 0; k < 3; ++k)
      if (w[k] == n_) return face[k];
    for (std::size_t k = 0; k < 3; ++k)
      if (w[k] == 0) return on_edge(face[(k + 1) % 3], face[(k + 2) % 3], w[(k + 2) % 3]);
    return add(double(w[0]) * corners_[face[0]] + double(w[1]) * corners_[face[1]] +
               double(w[2]) * corners_[face[2]]);
  }

 private:
  /// Point `step` of n from corner a towards corner b; made once, for whichever face asks first.
  std::uint32_t on_edge(std::uint32_t a, std::uint32_t b, int step) {
    if (a > b) return on_edge(b, a, n_ - step);
    const auto [entry, fresh] = edges_.try_emplace({a, b}, std::uint32_t(vertices_.size()));
    if (fresh)
      for (int s = 1; s < n_; ++s) add(double(n_ - s) * corners_[a] + double(s) * corners_[b]);
    return entry->second + std::uint32_t(step) - 1;
  }

  std::uint32_t add(const Vec3& p) {
    vertices_.push_back(p.normalized());
    return std::uint32_t(vertices_.size()) - 1;
  }

  const std::array<Vec3, 12>& corners_;
  int n_;
  std::vector<Vec3>& vertices_;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> edges_;
};

/// Cuts one face into n rows; row i has n - i triangles pointing as the face does and n - i - 1 the other
/// way.
void divide(const Triangle& face, int n, Numbering& number, std::vector<Triangle>& out) {
  std::vector<std::uint32_t> row, next;
  const auto number_row = [&](int i) {
    std::vector<std::uint32_t> r;
    for (int j = 0; j <= n - i; ++j) r.push_back(number(face, {n - i - j, j, i}));
    return r;
  };
  row = number_row(0);
  for (int i = 0; i < n; ++i) {
    next = number_row(i + 1);
    for (std::size_t j = 0; j + 1 < row.size(); ++j) {
      out.push_back({row[j], row[j + 1], next[j]});
      if (j + 1 < next.size()) out.push_back({row[j + 1], next[j + 1], next[j]});
    }
    row = next;
  }
}

}  // namespace

TriangleMesh geodesic_sphere(int frequency) {
  require_fineness(frequency, max_frequency);
  const std::array<Vec3, 12> corners = icosahedron_corners();
  TriangleMesh mesh;
  const auto n = std::size_t(frequency);
  mesh.vertices.reserve(10 * n * n + 2);
  mesh.triangles.reserve(20 * n * n);
  Numbering number(corners, frequency, mesh.vertices);
  for (const Triangle& face : icosahedron_faces(corners)) divide(face, frequency, number, mesh.triangles);
  return mesh;
}

TriangleMesh wrap_geodesic(int frequency, const std::function<Vec3(const Vec3&)>& surface) {
  TriangleMesh mesh = geodesic_sphere(frequency);
  for (Vec3& v : mesh.vertices) v = surface(v);
  return mesh;
}

}  // namespace kreisel::core
