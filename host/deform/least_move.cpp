#include "deform/least_move.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/triangle.hpp"

namespace kreisel::core {
namespace {

constexpr double cells = 20;  ///< along the longest side, in which one vertex stands for the others

using Cell = std::array<int, 3>;

Cell cell_of(const Vec3& at) {
  return {static_cast<int>(std::floor(at[0])), static_cast<int>(std::floor(at[1])),
          static_cast<int>(std::floor(at[2]))};
}

/// The vertex of each cell with the least value. @param value  of a vertex in units of cells, or nothing
template <class Value>
std::vector<Eigen::Index> least_of_cells(const TriangleMesh& mesh, const Vec3& about, double cell,
                                         const Value& value) {
  std::map<Cell, std::pair<double, Eigen::Index>> least;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 at = (mesh.vertices[i] - about) / cell;
    const std::pair one{value(at), static_cast<Eigen::Index>(i)};
    const auto [place, is_new] = least.try_emplace(cell_of(at), one);
    if (!is_new) place->second = std::min(place->second, one);
  }
  std::vector<Eigen::Index> chosen;
  for (const auto& [place, one] : least) chosen.push_back(one.second);
  return chosen;
}

/// The one nearest to the middle of each cell, so that a mirror image has the mirror images.
std::vector<Eigen::Index> spread_vertices(const TriangleMesh& mesh) {
  const Box box = bounding_box(mesh);
  return least_of_cells(mesh, box.centre(), box.extent().maxCoeff() / cells, [](const Vec3& at) {
    return (at - Vec3(at.array().floor()) - Vec3::Constant(0.5)).norm();
  });
}

/// These vertices, and the air a little above them.
std::vector<Vec3> watched_points(const TriangleMesh& mesh, const std::vector<Eigen::Index>& vertices) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) normals[v] += normal_of(mesh, t);
  const double above = 0.04 * bounding_box(mesh).extent().maxCoeff();
  std::vector<Vec3> points;
  for (const Eigen::Index v : vertices) {
    const auto i = static_cast<std::size_t>(v);
    points.push_back(mesh.vertices[i]);
    points.push_back(mesh.vertices[i] + above * normals[i].normalized());
  }
  return points;
}

/// Midway between the largest and the least along each axis.
Eigen::RowVector3d middle(const Eigen::MatrixX3d& d) {
  return (d.colwise().maxCoeff() + d.colwise().minCoeff()) / 2;
}

constexpr double penalty = 1e3;  ///< of a missed row: far above what any motion costs

}  // namespace

LeastMove::LeastMove(const TriangleMesh& mesh, const Handles& handles, const Vec3& anchor,
                     const MoveOptions& options)
    : options_(options),
      side_(bounding_box(mesh).extent().maxCoeff()),
      motion_(mesh, handles, anchor),
      spread_(spread_vertices(mesh)),
      determinants_(watched_points(mesh, spread_), handles),
      rows_(static_cast<Eigen::Index>(spread_.size()), motion_.handles()),
      bending_(handles.bending()),
      emphasis_(Eigen::VectorXd::Ones(static_cast<Eigen::Index>(spread_.size()))) {
  for (std::size_t i = 0; i < spread_.size(); ++i)
    rows_.row(static_cast<Eigen::Index>(i)) = motion_.row(spread_[i]);
  if (options.held) rows_.rowwise() += motion_.anchor_row();
  if (bounding_box(mesh).lo[2] >= anchor[2] - 1e-6) find_low(mesh, anchor);
}

/// A body on its lowest point stays on it: the lowest vertices, one a cell.
void LeastMove::find_low(const TriangleMesh& mesh, const Vec3& anchor) {
  for (const Eigen::Index i :
       least_of_cells(mesh, anchor, side_ / cells, [](const Vec3& at) { return at[2]; }))
    if (const double height = mesh.vertices[static_cast<std::size_t>(i)][2] - anchor[2];
        height < 0.25 * side_)
      low_.push_back({height, motion_.row(i).transpose()});
}

Eigen::MatrixX3d LeastMove::displacement(const Eigen::MatrixX3d& u) const {
  Eigen::MatrixX3d d = motion_.displacement(u);
  if (options_.held)
    d.rowwise() += motion_.of_anchor(u);
  else
    d.rowwise() -= middle(d);
  return d;
}

Eigen::MatrixXd LeastMove::energy(const Eigen::VectorXd& emphasis) const {
  const double total = emphasis.sum();
  Eigen::MatrixXd square = rows_.transpose() * emphasis.asDiagonal() * rows_ / total;
  if (!options_.held) {
    const Eigen::RowVectorXd mean = emphasis.transpose() * rows_ / total;
    square -= mean.transpose() * mean;
  }
  square += options_.bending * bending_;
  square.diagonal().array() += 1e-7;  // of what moves nothing
  return square;
}

/// What is displaced most counts most: the p-norm of the displacements as a sum of squares whose weights are
/// their powers of p - 2. From square to square they go a part of the way, for all of it overshoots.
void LeastMove::emphasise(const Eigen::MatrixX3d& u) {
  constexpr double p = 12, part = 1.5 / (p - 1);
  Eigen::MatrixX3d d = rows_ * u;
  if (!options_.held) d.rowwise() -= Eigen::RowVector3d(emphasis_.transpose() * d / emphasis_.sum());
  const Eigen::VectorXd size = d.rowwise().norm();
  if (!(size.maxCoeff() > 0)) return;
  const Eigen::VectorXd wanted = (size / size.maxCoeff()).array().pow(p - 2).max(1e-6);
  emphasis_ = emphasis_.array().pow(1 - part) * wanted.array().pow(part);
  emphasis_ /= emphasis_.maxCoeff();
}

void LeastMove::add_own(HandleRows& rows, const Eigen::MatrixX3d& from, const Eigen::MatrixX3d& to) const {
  const double near = 0.1 * side_;
  for (const auto& [height, row] : low_) {
    if (height + row.dot(to.col(2)) > near) continue;
    Eigen::MatrixX3d down = Eigen::MatrixX3d::Zero(motion_.handles(), 3);
    down.col(2) = -row;
    rows.add(down, height - std::min(height, 2e-3) / 2);
  }
  // Where space is shrunk most, here or there; linear about here.
  std::vector<std::pair<double, std::size_t>> small;
  for (std::size_t i = 0; i < determinants_.size(); ++i)
    if (const double at = std::min(determinants_.at(i, from), determinants_.at(i, to));
        at < options_.least_determinant + 0.2)
      small.emplace_back(at, i);
  constexpr std::size_t most = 150;
  std::ranges::sort(small);
  if (small.size() > most) small.resize(most);
  constexpr double spare = 0.02;
  for (const auto& [at, i] : small) {
    const Eigen::MatrixX3d slope = determinants_.gradient(i, from);
    rows.add(-slope,
             determinants_.at(i, from) - options_.least_determinant - spare - slope.cwiseProduct(from).sum());
  }
}

Eigen::MatrixX3d LeastMove::cut_short(const Eigen::MatrixX3d& from, const Eigen::MatrixX3d& to,
                                      double most) const {
  const double far = (rows_ * (to - from)).rowwise().norm().maxCoeff();
  return from + std::min(1.0, most / std::max(far, 1e-300)) * (to - from);
}

Eigen::MatrixX3d LeastMove::step(const Eigen::MatrixX3d& u, const HandleRows& rows, double most) {
  const Eigen::MatrixX3d nil = Eigen::MatrixX3d::Zero(motion_.handles(), 3);
  Eigen::MatrixX3d to = u;
  constexpr int rounds = 4;  // of emphasis, and of what else comes into play on the way
  for (int round = 0; round < rounds; ++round) {
    HandleRows all = rows;
    add_own(all, u, to);
    to = cut_short(u, nearest_point(energy(emphasis_), nil, nil, all, penalty), most);
    emphasise(to);
  }
  return to;
}

Eigen::MatrixX3d LeastMove::descend(const Eigen::MatrixX3d& u, const Eigen::MatrixX3d& slope,
                                    const HandleRows& rows, double within, double most) const {
  const Eigen::MatrixXd metric = energy(Eigen::VectorXd::Ones(emphasis_.size()));
  // Scaled so that without rows it would go about as far as it may.
  const Eigen::MatrixX3d down = metric.llt().solve(slope);
  const double far = (rows_ * down).rowwise().norm().maxCoeff();
  const Eigen::MatrixX3d pull = most / std::max(far, 1e-300) * slope;
  const Eigen::RowVectorXd mean = options_.held ? Eigen::RowVectorXd::Zero(motion_.handles())
                                                : Eigen::RowVectorXd(rows_.colwise().mean());
  Eigen::MatrixX3d to = u;
  HandleRows all = rows;
  add_own(all, u, u);
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    // Balls about where the spread vertices were, by the planes that touch them where they are.
    for (Eigen::Index i = 0; i < rows_.rows(); ++i) {
      const Eigen::RowVectorXd row = rows_.row(i) - mean;
      const Eigen::RowVector3d d = row * to;
      if (d.norm() < 0.8 * within) continue;
      all.add(row.transpose() * (d / d.norm()), 0.97 * within);
    }
    to = cut_short(u, nearest_point(metric, u, pull, all, penalty * std::max(1.0, pull.norm())), most);
  }
  return to;
}

}  // namespace kreisel::core
