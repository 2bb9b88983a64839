// handle_motion.hpp - a mesh that handles move.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "deform/handles.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Displacements of all vertices from those of the handles, seen from an anchor that goes along: the anchor
/// stays where it is, for where a body is in space means nothing.
class HandleMotion {
 public:
  HandleMotion(const TriangleMesh& mesh, const Handles& handles, const Vec3& anchor);

  [[nodiscard]] Eigen::Index handles() const { return weights_.cols(); }
  /// Of every vertex. @param u  (handles, 3)
  [[nodiscard]] Eigen::MatrixX3d displacement(const Eigen::MatrixX3d& u) const;
  /// Of the anchor itself, seen from where nothing moves.
  [[nodiscard]] Eigen::RowVector3d of_anchor(const Eigen::MatrixX3d& u) const { return anchor_ * u; }
  [[nodiscard]] TriangleMesh moved(const Eigen::MatrixX3d& u) const;
  /// The derivative in u of what has the derivative `gradient` in the vertices.
  [[nodiscard]] Eigen::MatrixX3d pulled_back(const std::vector<Vec3>& gradient) const;
  /// The weights of one vertex, less the anchor's: its displacement along any axis is row . u.
  [[nodiscard]] Eigen::RowVectorXd row(Eigen::Index vertex) const;
  [[nodiscard]] const Eigen::RowVectorXd& anchor_row() const { return anchor_; }

 private:
  const TriangleMesh& mesh_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> weights_;
  Eigen::RowVectorXd anchor_;
};

/// The determinant of a motion's derivative at points of space, and where it is small: below 0 space is
/// turned inside out.
class Determinants {
 public:
  Determinants(const std::vector<Vec3>& points, const Handles& handles);

  [[nodiscard]] std::size_t size() const { return weights_.size(); }
  [[nodiscard]] double at(std::size_t point, const Eigen::MatrixX3d& u) const;
  [[nodiscard]] double least(const Eigen::MatrixX3d& u) const;
  /// Its derivative in u.
  [[nodiscard]] Eigen::MatrixX3d gradient(std::size_t point, const Eigen::MatrixX3d& u) const;

 private:
  [[nodiscard]] Eigen::Matrix3d derivative(std::size_t point, const Eigen::MatrixX3d& u) const;
  std::vector<HandleWeights> weights_;
};

}  // namespace kreisel::core
