#include "deform/surface_energy.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <set>
#include <vector>

#include "parallel.hpp"

namespace kreisel::core {
namespace {

std::vector<std::vector<std::uint32_t>> neighbours_of(const TriangleMesh& mesh) {
  std::vector<std::set<std::uint32_t>> all(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t other : {(k + 1) % 3, (k + 2) % 3}) all[t[k]].insert(t[other]);
  std::vector<std::vector<std::uint32_t>> lists;
  for (const auto& one : all) lists.emplace_back(one.begin(), one.end());
  return lists;
}

/// What scale and small rotation (s, h) do to a vector: s x + h cross x, as a matrix on (s, h).
Eigen::Matrix<double, 3, 4> similarity(const Vec3& x) {
  Eigen::Matrix<double, 3, 4> m;
  m << x[0], 0, x[2], -x[1], x[1], -x[2], 0, x[0], x[2], x[1], -x[0], 0;
  return m;
}

/// L_D at one vertex: a 3 x 3 block for it and for each of its neighbours, in that order.
std::vector<Eigen::Matrix3d> laplacian_at(const TriangleMesh& mesh, std::uint32_t vertex,
                                          const std::vector<std::uint32_t>& around) {
  std::vector<std::uint32_t> all = {vertex};
  all.insert(all.end(), around.begin(), around.end());
  const auto count = static_cast<double>(all.size());
  Vec3 mean = Vec3::Zero();
  for (const std::uint32_t v : all) mean += mesh.vertices[v] / count;
  Vec3 delta = mesh.vertices[vertex];
  for (const std::uint32_t v : around) delta -= mesh.vertices[v] / static_cast<double>(around.size());
  // (s, h) is the least squares fit to what the displacements do around their mean: as rows cancel there, it
  // is a sum over the vertices.
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  for (const std::uint32_t v : all) {
    const auto m = similarity(mesh.vertices[v] - mean);
    normal += m.transpose() * m;
  }
  normal.diagonal().array() += 1e-9 * normal.trace();  // where all lie on a line
  const Eigen::Matrix<double, 3, 4> turned = similarity(delta) * normal.inverse();
  std::vector<Eigen::Matrix3d> blocks;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double uniform = k == 0 ? 1 : -1 / static_cast<double>(around.size());
    blocks.emplace_back(uniform * Eigen::Matrix3d::Identity() -
                        turned * similarity(mesh.vertices[all[k]] - mean).transpose());
  }
  return blocks;
}

/// side^2 / e^2.
double bend_scale(const TriangleMesh& mesh, std::uint32_t vertex, const std::vector<std::uint32_t>& around,
                  double side) {
  double edge = 0;
  for (const std::uint32_t other : around) edge += (mesh.vertices[other] - mesh.vertices[vertex]).norm();
  edge /= static_cast<double>(around.size());
  return side * side / (edge * edge);
}

}  // namespace

Eigen::MatrixXd displacement_rows(const HandleWeights& weights, const Vec3& v, std::size_t handles) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, 4 * static_cast<Eigen::Index>(handles));
  for (const HandleWeight& w : weights) {
    const Eigen::Index at = 4 * static_cast<Eigen::Index>(w.handle);
    rows.col(at) = w.weight * v;
    rows.block<3, 3>(0, at + 1).diagonal().setConstant(w.weight);
  }
  return rows;
}

Eigen::MatrixXd surface_energy(const TriangleMesh& mesh, const CageHandles& handles, double gamma_dl,
                               double gamma_dv) {
  const std::size_t n = mesh.vertices.size(), count = handles.count();
  const Eigen::Index size = 4 * static_cast<Eigen::Index>(count);
  std::vector<HandleWeights> weights(n);
  parallel_for(n, 256, [&](std::size_t v) { weights[v] = handles.at(mesh.vertices[v]); });
  const auto around = neighbours_of(mesh);
  const double side = bounding_box(mesh.vertices).extent().maxCoeff();
  const auto rows_of = [&](std::uint32_t v) {
    return displacement_rows(weights[v], mesh.vertices[v], count);
  };
  Eigen::MatrixXd energy = Eigen::MatrixXd::Zero(size, size), mean = Eigen::MatrixXd::Zero(3, size);
  constexpr std::size_t at_once = 256;  // vertices whose rows are added as one product
  for (std::size_t begin = 0; begin < n; begin += at_once) {
    stop_here();
    const std::size_t end = std::min(n, begin + at_once);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(end - begin), size);
    parallel_for(end - begin, [&](std::size_t i) {
      const auto v = static_cast<std::uint32_t>(begin + i);
      const auto at = 6 * static_cast<Eigen::Index>(i);
      rows.middleRows<3>(at) = std::sqrt(gamma_dv) * rows_of(v);
      if (around[v].empty()) return;
      const double scale = std::sqrt(gamma_dl) * bend_scale(mesh, v, around[v], side);
      const std::vector<Eigen::Matrix3d> blocks = laplacian_at(mesh, v, around[v]);
      auto bent = rows.middleRows<3>(at + 3);
      bent = scale * blocks[0] * rows_of(v);
      for (std::size_t k = 0; k < around[v].size(); ++k)
        bent += scale * blocks[k + 1] * rows_of(around[v][k]);
    });
    energy.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose(), 2 / static_cast<double>(n));
    for (std::size_t i = 0; i < end - begin; ++i)
      mean += rows.middleRows<3>(6 * static_cast<Eigen::Index>(i)) / static_cast<double>(n);
  }
  energy = Eigen::MatrixXd(energy.selfadjointView<Eigen::Lower>());
  energy -= 2 * mean.transpose() * mean;
  return energy;
}

double surface_energy(const TriangleMesh& mesh, const std::vector<Vec3>& to, double gamma_dl,
                      double gamma_dv) {
  const auto n = static_cast<double>(mesh.vertices.size());
  const auto around = neighbours_of(mesh);
  const double side = bounding_box(mesh.vertices).extent().maxCoeff();
  const auto displacement = [&](std::uint32_t v) -> Vec3 { return to[v] - mesh.vertices[v]; };
  Vec3 mean = Vec3::Zero();
  for (std::uint32_t v = 0; v < to.size(); ++v) mean += displacement(v) / n;
  double far = 0, bent = 0;
  for (std::uint32_t v = 0; v < to.size(); ++v) {
    far += (displacement(v) - mean).squaredNorm();
    if (around[v].empty()) continue;
    const std::vector<Eigen::Matrix3d> blocks = laplacian_at(mesh, v, around[v]);
    Vec3 sum = blocks[0] * displacement(v);
    for (std::size_t k = 0; k < around[v].size(); ++k) sum += blocks[k + 1] * displacement(around[v][k]);
    bent += (bend_scale(mesh, v, around[v], side) * sum).squaredNorm();
  }
  return (gamma_dl * bent + gamma_dv * far) / n;
}

}  // namespace kreisel::core
