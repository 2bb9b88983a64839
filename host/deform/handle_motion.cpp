#include "deform/handle_motion.hpp"

#include <algorithm>
#include <limits>

#include "parallel.hpp"

namespace kreisel::core {

HandleMotion::HandleMotion(const TriangleMesh& mesh, const Handles& handles, const Vec3& anchor)
    : mesh_(mesh),
      weights_(static_cast<Eigen::Index>(mesh.vertices.size()), static_cast<Eigen::Index>(handles.count())),
      anchor_(Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(handles.count()))) {
  std::vector<HandleWeights> all(mesh.vertices.size());
  parallel_for(all.size(), 1024, [&](std::size_t i) { all[i] = handles.at(mesh.vertices[i]); });
  std::vector<Eigen::Index> sizes;
  for (const HandleWeights& one : all) sizes.push_back(static_cast<Eigen::Index>(one.size()));
  weights_.reserve(sizes);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const HandleWeight& w : all[i]) weights_.insert(static_cast<Eigen::Index>(i), w.handle) = w.weight;
  weights_.makeCompressed();
  for (const HandleWeight& w : handles.at(anchor)) anchor_[w.handle] = w.weight;
}

Eigen::MatrixX3d HandleMotion::displacement(const Eigen::MatrixX3d& u) const {
  Eigen::MatrixX3d d = weights_ * u;
  d.rowwise() -= of_anchor(u);
  return d;
}

TriangleMesh HandleMotion::moved(const Eigen::MatrixX3d& u) const {
  TriangleMesh mesh = mesh_;
  const Eigen::MatrixX3d d = displacement(u);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    mesh.vertices[i] += d.row(static_cast<Eigen::Index>(i)).transpose();
  return mesh;
}

Eigen::MatrixX3d HandleMotion::pulled_back(const std::vector<Vec3>& gradient) const {
  Eigen::MatrixX3d g(static_cast<Eigen::Index>(gradient.size()), 3);
  for (std::size_t i = 0; i < gradient.size(); ++i) g.row(static_cast<Eigen::Index>(i)) = gradient[i];
  const Eigen::RowVector3d total = g.colwise().sum();
  Eigen::MatrixX3d result = weights_.transpose() * g;
  result -= anchor_.transpose() * total;
  return result;
}

Eigen::RowVectorXd HandleMotion::row(Eigen::Index vertex) const {
  Eigen::RowVectorXd all = -anchor_;
  for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator w(weights_, vertex); w; ++w)
    all[w.col()] += w.value();
  return all;
}

Determinants::Determinants(const std::vector<Vec3>& points, const Handles& handles) {
  for (const Vec3& p : points) weights_.push_back(handles.at(p));
}

Eigen::Matrix3d Determinants::derivative(std::size_t point, const Eigen::MatrixX3d& u) const {
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  for (const HandleWeight& w : weights_[point]) J += u.row(w.handle).transpose() * w.gradient.transpose();
  return J;
}

double Determinants::at(std::size_t point, const Eigen::MatrixX3d& u) const {
  return derivative(point, u).determinant();
}

double Determinants::least(const Eigen::MatrixX3d& u) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size(); ++i) least = std::min(least, at(i, u));
  return least;
}

Eigen::MatrixX3d Determinants::gradient(std::size_t point, const Eigen::MatrixX3d& u) const {
  const Eigen::Matrix3d J = derivative(point, u);
  Eigen::Matrix3d cofactors;  // d det / dJ, finite where J is singular, too
  cofactors.row(0) = J.row(1).cross(J.row(2));
  cofactors.row(1) = J.row(2).cross(J.row(0));
  cofactors.row(2) = J.row(0).cross(J.row(1));
  Eigen::MatrixX3d g = Eigen::MatrixX3d::Zero(u.rows(), 3);
  for (const HandleWeight& w : weights_[point]) g.row(w.handle) = (cofactors * w.gradient).transpose();
  return g;
}

}  // namespace kreisel::core
