#include "deform/cage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "domain/exact.hpp"
#include "geometry/triangle.hpp"

namespace kreisel::core {
namespace {

/// Whether a triangle runs through the inside of a cube about the origin: no axis parts them. Of two convex
/// bodies with flat sides it would be one of these. [Akenine-Moller 2001]
bool runs_through(const std::array<Vec3, 3>& t, double half) {
  const auto parted = [&](const Vec3& axis) {
    const double a = axis.dot(t[0]), b = axis.dot(t[1]), c = axis.dot(t[2]);
    const double reach = half * axis.lpNorm<1>() * (1 - 1e-9);
    return std::min({a, b, c}) >= reach || std::max({a, b, c}) <= -reach;
  };
  if (parted(normal_of(t[0], t[1], t[2]))) return false;
  for (int a = 0; a < 3; ++a) {
    if (parted(Vec3::Unit(a))) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 axis = Vec3::Unit(a).cross(t[(k + 1) % 3] - t[k]);
      if (axis.squaredNorm() > 0 && parted(axis)) return false;
    }
  }
  return true;
}

template <class Visit>
void for_places(const Cage::Place& lo, const Cage::Place& hi, const Visit& visit) {
  for (int k = lo[2]; k < hi[2]; ++k)
    for (int j = lo[1]; j < hi[1]; ++j)
      for (int i = lo[0]; i < hi[0]; ++i) visit(Cage::Place{i, j, k});
}

std::size_t in_order(const Cage::Place& at, const Cage::Place& n) {
  return static_cast<std::size_t>(at[0] + n[0] * (at[1] + n[1] * at[2]));
}

/// Which cells the solid meets: the surface runs through them, or their middle is inside.
std::vector<std::uint8_t> met_by(const TriangleMesh& mesh, const CageGrid& cage) {
  std::vector<std::uint8_t> met(static_cast<std::size_t>(cage.cells[0]) * cage.cells[1] * cage.cells[2]);
  const auto middle = [&](const Cage::Place& at) {
    return Vec3(cage.origin + cage.edge * (Vec3(at[0], at[1], at[2]) + Vec3::Constant(0.5)));
  };
  for (const Triangle& triangle : mesh.triangles) {
    const auto corners = corners_of(mesh, triangle);
    const Box box = bounding_box(corners);
    Cage::Place lo, hi;
    for (int a = 0; a < 3; ++a) {
      const auto at = static_cast<std::size_t>(a);
      const auto cell = [&](double x) {
        return std::clamp(static_cast<int>(std::floor((x - cage.origin[a]) / cage.edge)), 0,
                          cage.cells[at] - 1);
      };
      lo[at] = cell(box.lo[a]);
      hi[at] = cell(box.hi[a]) + 1;
    }
    for_places(lo, hi, [&](const Cage::Place& at) {
      std::uint8_t& here = met[in_order(at, cage.cells)];
      if (here) return;
      std::array<Vec3, 3> about = corners;
      for (Vec3& v : about) v -= middle(at);
      here = runs_through(about, cage.edge / 2);
    });
  }
  Grid middles;
  middles.n = cage.cells;
  middles.origin = cage.origin;
  middles.h = cage.edge;
  for (const ExactInterval& run : SolidLines(mesh, middles).intervals(0))
    for (int k = 0; k < cage.cells[2]; ++k)
      if (const double z = middles.centre(2, k); run.z0 < z && z < run.z1)
        met[in_order({run.ix, run.iy, k}, cage.cells)] = 1;
  return met;
}

}  // namespace

CageGrid centred_cage_grid(const TriangleMesh& mesh, int level, int fine) {
  const Box box = bounding_box(mesh);
  CageGrid grid;
  grid.edge = box.extent().maxCoeff() / (1 << level);
  grid.finer = 1 << (fine - level);
  for (int a = 0; a < 3; ++a) {
    const int along = std::max(1, static_cast<int>(std::ceil(box.extent()[a] / grid.edge - 1e-9)));
    grid.cells[static_cast<std::size_t>(a)] = along;
    grid.origin[a] = box.centre()[a] - grid.edge * along / 2;
  }
  return grid;
}

Cage::Cage(const TriangleMesh& mesh, const CageGrid& grid) : Cage(grid, met_by(mesh, grid)) {}

Cage Cage::regridded(int finer) const {
  CageGrid grid = grid_;
  grid.finer = finer;
  return {grid, met_};
}

Cage::Cage(const CageGrid& grid, std::vector<std::uint8_t> met) : grid_(grid), met_(std::move(met)) {
  const int finer = grid.finer;
  const Place none{0, 0, 0};
  index_.assign(slot({grid.cells[0] * finer, grid.cells[1] * finer, grid.cells[2] * finer}) + 1, -1);
  for_places(none, grid.cells, [&](const Place& cell) {
    if (!met_[in_order(cell, grid.cells)]) return;
    of_level_.push_back(cell);
    const Place lo = {cell[0] * finer, cell[1] * finer, cell[2] * finer},
                hi = {lo[0] + finer, lo[1] + finer, lo[2] + finer};
    for_places(lo, hi, [&](const Place& at) { cells_.push_back(at); });
    for_places(lo, {hi[0] + 1, hi[1] + 1, hi[2] + 1}, [&](const Place& at) {
      std::int32_t& node = index_[slot(at)];
      if (node >= 0) return;
      node = static_cast<std::int32_t>(nodes_.size());
      nodes_.push_back(at);
    });
  });
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    const Place& at = nodes_[n];
    if (at[0] % finer != 0 || at[1] % finer != 0 || at[2] % finer != 0) continue;
    const Place corner = {at[0] / finer, at[1] / finer, at[2] / finer};
    int around = 0;
    for_places({corner[0] - 1, corner[1] - 1, corner[2] - 1}, {corner[0] + 1, corner[1] + 1, corner[2] + 1},
               [&](const Place& cell) { around += holds(cell); });
    if (around < 8) handles_.push_back(n);
  }
}

bool Cage::holds(const Place& cell) const {
  for (std::size_t a = 0; a < 3; ++a)
    if (cell[a] < 0 || cell[a] >= grid_.cells[a]) return false;
  return met_[in_order(cell, grid_.cells)] != 0;
}

std::size_t Cage::slot(const Place& node) const {
  return in_order(node, {grid_.cells[0] * grid_.finer + 1, grid_.cells[1] * grid_.finer + 1,
                         grid_.cells[2] * grid_.finer + 1});
}

std::int32_t Cage::node(const Place& at) const {
  for (std::size_t a = 0; a < 3; ++a)
    if (at[a] < 0 || at[a] > grid_.cells[a] * grid_.finer) return -1;
  return index_[slot(at)];
}

std::array<std::uint32_t, 8> Cage::corners(const Place& cell) const {
  std::array<std::uint32_t, 8> all;
  for (int part = 0; part < 8; ++part)
    all[static_cast<std::size_t>(part)] = static_cast<std::uint32_t>(
        index_[slot({cell[0] + (part & 1), cell[1] + (part >> 1 & 1), cell[2] + (part >> 2)})]);
  return all;
}

Cage::Inside Cage::inside(const Vec3& x) const {
  const Vec3 in_cells = (x - grid_.origin) / grid_.edge;
  const Vec3 floor = in_cells.array().floor();
  Place cell = {static_cast<int>(floor[0]), static_cast<int>(floor[1]), static_cast<int>(floor[2])};
  if (!holds(cell)) {
    double least = std::numeric_limits<double>::infinity();
    for (const Place& one : of_level_) {
      const Vec3 corner(one[0], one[1], one[2]);
      const Vec3 nearest = in_cells.cwiseMax(corner).cwiseMin(corner + Vec3::Ones());
      const double far = (in_cells - nearest).squaredNorm();
      if (far < least) least = far, cell = one;
    }
  }
  Inside result{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double within = in_cells[static_cast<Eigen::Index>(a)] - cell[a];
    const double fine = std::clamp(within, 0.0, 1.0) * grid_.finer;
    const int step = std::min(static_cast<int>(fine), grid_.finer - 1);
    result.cell[a] = cell[a] * grid_.finer + step;
    result.at[static_cast<Eigen::Index>(a)] = fine - step;
    result.moved[a] = within < 0 || within > 1;
  }
  return result;
}

std::array<double, 8> Cage::Inside::shares() const {
  std::array<double, 8> all;
  for (std::size_t part = 0; part < 8; ++part) {
    all[part] = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      const double t = at[static_cast<Eigen::Index>(a)];
      all[part] *= part >> a & 1 ? t : 1 - t;
    }
  }
  return all;
}

}  // namespace kreisel::core
