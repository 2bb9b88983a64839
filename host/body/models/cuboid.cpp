#include <cmath>
#include <map>

#include "body/models/shapes.hpp"

namespace kreisel::core {
namespace {

const std::array<int, 3> tens_of_mm = {6, 4, 3};

/// Numbers the points of the cubic lattice that lie on the surface.
class LatticeNumbering {
 public:
  LatticeNumbering(TriangleMesh& mesh, double step) : mesh_(mesh), step_(step) {}

  std::uint32_t operator()(const std::array<int, 3>& at) {
    const auto [entry, fresh] = numbers_.try_emplace(at, std::uint32_t(mesh_.vertices.size()));
    if (fresh) mesh_.vertices.push_back(step_ * Vec3(at[0], at[1], at[2]));
    return entry->second;
  }

 private:
  TriangleMesh& mesh_;
  double step_;
  std::map<std::array<int, 3>, std::uint32_t> numbers_;
};

}  // namespace

TriangleMesh cuboid_shape(int fineness) {
  require_fineness(fineness, 1000);
  // 216 k^2 triangles: two for each square of 10 / k mm.
  const int k = std::max(1, int(std::lround(std::sqrt(20.0 / 216) * fineness)));
  TriangleMesh mesh;
  LatticeNumbering number(mesh, 10.0 / k);
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t u = (a + 1) % 3, v = (a + 2) % 3;
    for (const bool far : {false, true})
      for (int i = 0; i < k * tens_of_mm[u]; ++i)
        for (int j = 0; j < k * tens_of_mm[v]; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> at{};
            at[a] = far ? k * tens_of_mm[a] : 0;
            at[u] = i + di;
            at[v] = j + dj;
            return number(at);
          };
          const std::uint32_t p = corner(0, 0), q = corner(1, 0), r = corner(1, 1), s = corner(0, 1);
          mesh.triangles.push_back(far ? Triangle{p, q, r} : Triangle{p, r, q});
          mesh.triangles.push_back(far ? Triangle{p, r, s} : Triangle{p, s, r});
        }
  }
  return mesh;
}

}  // namespace kreisel::core
