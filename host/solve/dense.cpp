#include "solve/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace kreisel::core {

using Eigen::MatrixXd;
using Eigen::VectorXd;

SymmetricModes symmetric_modes(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(a);
  return {modes.eigenvalues(), modes.eigenvectors()};
}

VectorXd shortest_solution(const MatrixXd& a, const VectorXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

VectorXd elimination(const MatrixXd& a, const VectorXd& b) { return a.fullPivLu().solve(b); }

VectorXd semidefinite_solution(const MatrixXd& a, const VectorXd& b) { return a.ldlt().solve(b); }

MatrixXd kernel_of(const MatrixXd& a, double threshold) {
  if (a.size() == 0) return MatrixXd::Identity(a.cols(), a.cols());
  Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeFullV);
  svd.setThreshold(threshold);
  return svd.matrixV().rightCols(a.cols() - svd.rank());
}

}  // namespace kreisel::core
