#include "deform/moved_cells.hpp"

#include <algorithm>
#include <cmath>

#include "parallel.hpp"

namespace kreisel::core {
namespace {

constexpr std::size_t points = 3;  ///< of Gauss and Legendre, on [0, 1]
constexpr std::array<double, points> place = {0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, points> share = {5.0 / 18, 8.0 / 18, 5.0 / 18};
constexpr std::size_t block = 64;  ///< parts that are worth a thread

/// Displacements at the eight corners of a cell.
using Corners = std::array<std::array<double, 3>, 8>;

/// Displacements along a line in x: value and slopes are linear in the place t.
struct Line {
  using Three = std::array<double, 3>;
  Three value{}, value_t{};  ///< value + t value_t; value_t is the slope along x, too
  Three y{}, y_t{}, z{}, z_t{};

  Line(const Corners& c, double v, double w) {
    for (std::size_t f = 0; f < 3; ++f) {
      const auto at = [&](std::size_t side, double p, double q) {
        return (1 - q) * ((1 - p) * c[side][f] + p * c[side + 2][f]) +
               q * ((1 - p) * c[side + 4][f] + p * c[side + 6][f]);
      };
      const auto along_y = [&](std::size_t side) {
        return (1 - w) * (c[side + 2][f] - c[side][f]) + w * (c[side + 6][f] - c[side + 4][f]);
      };
      const auto along_z = [&](std::size_t side) {
        return (1 - v) * (c[side + 4][f] - c[side][f]) + v * (c[side + 6][f] - c[side + 2][f]);
      };
      value[f] = at(0, v, w), value_t[f] = at(1, v, w) - value[f];
      y[f] = along_y(0), y_t[f] = along_y(1) - y[f];
      z[f] = along_z(0), z_t[f] = along_z(1) - z[f];
    }
  }
  Line() = default;

  /// What the corners have of sums over this line. @param scale  slopes count so much
  void spread(Corners& c, double v, double w, double scale) const {
    for (std::size_t f = 0; f < 3; ++f)
      for (std::size_t side = 0; side < 2; ++side) {
        const double of_value = side ? value_t[f] : value[f] - value_t[f],
                     of_y = scale * (side ? y_t[f] : y[f] - y_t[f]),
                     of_z = scale * (side ? z_t[f] : z[f] - z_t[f]);
        c[side][f] += (1 - v) * (1 - w) * of_value - (1 - w) * of_y - (1 - v) * of_z;
        c[side + 2][f] += v * (1 - w) * of_value + (1 - w) * of_y - v * of_z;
        c[side + 4][f] += (1 - v) * w * of_value - w * of_y + (1 - v) * of_z;
        c[side + 6][f] += v * w * of_value + w * of_y + v * of_z;
      }
  }
};

/// Where a point goes, and how space is stretched there.
struct Moved {
  std::array<double, 3> at;
  std::array<std::array<double, 3>, 3> cofactors;  ///< of the derivative
  double determinant;
};

/// @param x  the point  @param t  its place on the line  @param per  slopes along an edge count so much
Moved moved(const Line& line, const std::array<double, 3>& x, double t, double per) {
  Moved result;
  std::array<std::array<double, 3>, 3> d;
  for (std::size_t a = 0; a < 3; ++a) {
    result.at[a] = x[a] + line.value[a] + t * line.value_t[a];
    d[a] = {per * line.value_t[a], per * (line.y[a] + t * line.y_t[a]), per * (line.z[a] + t * line.z_t[a])};
    d[a][a] += 1;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const auto& p = d[(a + 1) % 3];
    const auto& q = d[(a + 2) % 3];
    result.cofactors[a] = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  }
  result.determinant =
      d[0][0] * result.cofactors[0][0] + d[0][1] * result.cofactors[0][1] + d[0][2] * result.cofactors[0][2];
  return result;
}

/// A part as the sums go over it.
struct Box3 {
  std::array<double, 3> corner;  ///< of the grid's cell
  double h;
  std::array<double, 3> lo, size;  ///< in the cell

  [[nodiscard]] double at(std::size_t axis, std::size_t point) const {
    return lo[axis] + size[axis] * place[point];
  }
  [[nodiscard]] double volume() const { return h * h * h * size[0] * size[1] * size[2]; }
};

/// Calls visit(line of points): v, w their place along y and z.
template <class Visit>
void for_lines(const Box3& box, const Visit& visit) {
  for (std::size_t k = 0; k < points; ++k)
    for (std::size_t j = 0; j < points; ++j) visit(box.at(1, j), box.at(2, k), share[j] * share[k]);
}

}  // namespace

MovedCells::MovedCells(const Cage& cage, const Columns& domain)
    : cage_(cage), domain_(domain), voxels_(static_cast<int>(std::lround(cage.grid().h() / domain.grid.h))) {
  const Grid& grid = domain.grid;
  for (int a = 0; a < 3; ++a)
    first_[static_cast<std::size_t>(a)] =
        static_cast<int>(std::lround((cage.grid().origin[a] - grid.origin[a]) / grid.h));
  inside_.assign(static_cast<std::size_t>(grid.n[0]) * grid.n[1] * grid.n[2], 0);
  for (const Interval& run : domain.intervals)
    for (int k = run.k0; k < run.k1; ++k) inside_[voxel(run.ix, run.iy, k)] = 1;
}

void MovedCells::add(std::uint32_t owner, std::uint32_t cell, const std::array<int, 3>& lo,
                     const std::array<int, 3>& hi) {
  Part part{owner, cell, {}, {}};
  for (std::size_t a = 0; a < 3; ++a) {
    const int corner = first_[a] + cage_.cells()[cell][a] * voxels_;
    part.lo[a] = static_cast<float>(lo[a] - corner) / static_cast<float>(voxels_);
    part.hi[a] = static_cast<float>(hi[a] - corner) / static_cast<float>(voxels_);
  }
  parts_.push_back(part);
}

/// In few boxes: from each corner that is left as far as it goes along z, then y, then x.
void MovedCells::add_inside(std::uint32_t owner, std::uint32_t cell, const std::array<int, 3>& lo,
                            const std::array<int, 3>& hi) {
  const std::array<int, 3> n = {hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]};
  left_.clear();
  for (int i = lo[0]; i < hi[0]; ++i)
    for (int j = lo[1]; j < hi[1]; ++j)
      for (int k = lo[2]; k < hi[2]; ++k) left_.push_back(inside_[voxel(i, j, k)]);
  const auto left = [&](int i, int j, int k) -> std::uint8_t& {
    return left_[static_cast<std::size_t>((i * n[1] + j) * n[2] + k)];
  };
  const auto all_left = [&](int i, int j, int end_j, int k, int end_k) {
    for (; j < end_j; ++j)
      for (int at = k; at < end_k; ++at)
        if (!left(i, j, at)) return false;
    return true;
  };
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k) {
        if (!left(i, j, k)) continue;
        int end_k = k + 1, end_j = j + 1, end_i = i + 1;
        while (end_k < n[2] && left(i, j, end_k)) ++end_k;
        while (end_j < n[1] && all_left(i, end_j, end_j + 1, k, end_k)) ++end_j;
        while (end_i < n[0] && all_left(end_i, j, end_j, k, end_k)) ++end_i;
        for (int a = i; a < end_i; ++a)
          for (int b = j; b < end_j; ++b)
            for (int c = k; c < end_k; ++c) left(a, b, c) = 0;
        add(owner, cell, {lo[0] + i, lo[1] + j, lo[2] + k}, {lo[0] + end_i, lo[1] + end_j, lo[2] + end_k});
      }
}

void MovedCells::set(std::span<const Cube> cells) {
  size_ = cells.size();
  parts_.clear();
  const Grid& grid = domain_.grid;
  // The grid's cells by their place.
  const std::array<int, 3> n = {cage_.grid().cells[0] * cage_.grid().finer,
                                cage_.grid().cells[1] * cage_.grid().finer,
                                cage_.grid().cells[2] * cage_.grid().finer};
  if (cell_.empty()) {
    cell_.assign(static_cast<std::size_t>(n[0]) * n[1] * n[2], -1);
    for (std::size_t c = 0; c < cage_.cells().size(); ++c) {
      const Cage::Place& at = cage_.cells()[c];
      cell_[static_cast<std::size_t>(at[0] + n[0] * (at[1] + n[1] * at[2]))] = static_cast<std::int32_t>(c);
    }
  }
  for (std::uint32_t owner = 0; owner < cells.size(); ++owner) {
    const Cube& cube = cells[owner];
    const std::array<int, 3> from = {cube.x, cube.y, cube.z};
    std::array<int, 3> to, low, high;
    for (std::size_t a = 0; a < 3; ++a) {
      to[a] = std::min(from[a] + cube.edge, grid.n[a]);
      low[a] = std::max(0, (from[a] - first_[a]) / voxels_);
      high[a] = std::min(n[a], (to[a] - 1 - first_[a]) / voxels_ + 1);
    }
    for (int ck = low[2]; ck < high[2]; ++ck)
      for (int cj = low[1]; cj < high[1]; ++cj)
        for (int ci = low[0]; ci < high[0]; ++ci) {
          const std::int32_t cell = cell_[static_cast<std::size_t>(ci + n[0] * (cj + n[1] * ck))];
          if (cell < 0) continue;
          const std::array<int, 3> c = {ci, cj, ck};
          std::array<int, 3> lo, hi;
          for (std::size_t a = 0; a < 3; ++a) {
            lo[a] = std::max(from[a], first_[a] + c[a] * voxels_);
            hi[a] = std::min(to[a], first_[a] + (c[a] + 1) * voxels_);
          }
          add_inside(owner, static_cast<std::uint32_t>(cell), lo, hi);
        }
  }
}

namespace {

Corners corners_of(const Cage& cage, const NodeMotion& motion, std::size_t cell) {
  Corners corners;
  const auto nodes = cage.corners(cage.cells()[cell]);
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t f = 0; f < 3; ++f) corners[k][f] = motion(nodes[k], static_cast<Eigen::Index>(f));
  return corners;
}

template <class Part>
Box3 box_of(const Cage& cage, const Part& part) {
  Box3 box;
  const Vec3 corner = cage.position(cage.cells()[part.cell]);
  box.h = cage.grid().h();
  for (std::size_t a = 0; a < 3; ++a) {
    box.corner[a] = corner[static_cast<Eigen::Index>(a)];
    box.lo[a] = part.lo[a];
    box.size[a] = static_cast<double>(part.hi[a]) - part.lo[a];
  }
  return box;
}

}  // namespace

Eigen::Matrix<double, 10, Eigen::Dynamic> MovedCells::moments(const NodeMotion& motion) const {
  Eigen::Matrix<double, 10, Eigen::Dynamic> of_parts(10, static_cast<Eigen::Index>(parts_.size()));
  parallel_for(parts_.size(), block, [&](std::size_t p) {
    const Box3 box = box_of(cage_, parts_[p]);
    const Corners corners = corners_of(cage_, motion, parts_[p].cell);
    Moments sum = Moments::Zero();
    for_lines(box, [&](double v, double w, double of_line) {
      const Line line(corners, v, w);
      for (std::size_t i = 0; i < points; ++i) {
        const double t = box.at(0, i);
        const std::array<double, 3> x = {box.corner[0] + box.h * t, box.corner[1] + box.h * v,
                                         box.corner[2] + box.h * w};
        const Moved to = moved(line, x, t, 1 / box.h);
        const double volume = of_line * share[i] * to.determinant;
        const auto [a, b, c] = to.at;
        sum[S1] += volume;
        sum[SX] += volume * a;
        sum[SY] += volume * b;
        sum[SZ] += volume * c;
        sum[SXY] += volume * a * b;
        sum[SYZ] += volume * b * c;
        sum[SXZ] += volume * a * c;
        sum[SXX] += volume * a * a;
        sum[SYY] += volume * b * b;
        sum[SZZ] += volume * c * c;
      }
    });
    of_parts.col(static_cast<Eigen::Index>(p)) = box.volume() * sum;
  });
  Eigen::Matrix<double, 10, Eigen::Dynamic> all =
      Eigen::Matrix<double, 10, Eigen::Dynamic>::Zero(10, static_cast<Eigen::Index>(size_));
  for (std::size_t p = 0; p < parts_.size(); ++p)
    all.col(parts_[p].owner) += of_parts.col(static_cast<Eigen::Index>(p));
  return all;
}

std::vector<NodeMotion> MovedCells::gradient(const NodeMotion& motion, std::span<const double> fill,
                                             std::span<const Moments> q) const {
  const std::size_t rows = q.size();
  std::vector<Corners> of_parts(rows * parts_.size());
  parallel_for(parts_.size(), block, [&](std::size_t p) {
    const Box3 box = box_of(cage_, parts_[p]);
    const Corners corners = corners_of(cage_, motion, parts_[p].cell);
    const double per = 1 / box.h, volume = box.volume() * fill[parts_[p].owner];
    std::span<Corners> out = std::span(of_parts).subspan(p * rows, rows);
    for (Corners& c : out) c = {};
    for_lines(box, [&](double v, double w, double of_line) {
      const Line line(corners, v, w);
      std::array<Moved, points> to;
      std::array<std::array<double, 3>, points> x;
      for (std::size_t i = 0; i < points; ++i) {
        const double t = box.at(0, i);
        x[i] = {box.corner[0] + box.h * t, box.corner[1] + box.h * v, box.corner[2] + box.h * w};
        to[i] = moved(line, x[i], t, per);
      }
      for (std::size_t r = 0; r < rows; ++r) {
        Line sums;
        for (std::size_t i = 0; i < points; ++i) {
          const auto [a, b, c] = to[i].at;
          const Moments& s = q[r];
          const double by_x = s[SX] + s[SXY] * b + s[SXZ] * c + 2 * s[SXX] * a,
                       by_y = s[SY] + s[SXY] * a + s[SYZ] * c + 2 * s[SYY] * b,
                       by_z = s[SZ] + s[SYZ] * b + s[SXZ] * a + 2 * s[SZZ] * c;
          const double value = s[S1] + (a * (s[SX] + by_x) + b * (s[SY] + by_y) + c * (s[SZ] + by_z)) / 2;
          const double here = volume * of_line * share[i], t = box.at(0, i);
          const double by_point = here * to[i].determinant, by_slope = here * value;
          const auto& m = to[i].cofactors;
          const std::array<double, 3> down = {by_point * by_x, by_point * by_y, by_point * by_z};
          for (std::size_t f = 0; f < 3; ++f) {
            sums.value[f] += down[f];
            sums.value_t[f] += t * down[f] + per * by_slope * m[f][0];
            sums.y[f] += by_slope * m[f][1], sums.y_t[f] += t * by_slope * m[f][1];
            sums.z[f] += by_slope * m[f][2], sums.z_t[f] += t * by_slope * m[f][2];
          }
        }
        sums.spread(out[r], v, w, per);
      }
    });
  });
  std::vector<NodeMotion> all(rows, NodeMotion::Zero(static_cast<Eigen::Index>(cage_.nodes().size()), 3));
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const auto nodes = cage_.corners(cage_.cells()[parts_[p].cell]);
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t k = 0; k < 8; ++k)
        for (std::size_t f = 0; f < 3; ++f)
          all[r](nodes[k], static_cast<Eigen::Index>(f)) += of_parts[p * rows + r][k][f];
  }
  return all;
}

}  // namespace kreisel::core
