// dense.hpp - decompositions of small dense matrices. Each takes the compiler seconds, so they have a file.
#pragma once

#include <Eigen/Core>

namespace kreisel::core {

struct SymmetricModes {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< a column each, orthonormal
};

/// Eigenvalues and eigenvectors. @param a  symmetric; its lower triangle is read
[[nodiscard]] SymmetricModes symmetric_modes(const Eigen::MatrixXd& a);

/// Of all that leave the least |a x - b|, the shortest x.
[[nodiscard]] Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// The solution of a square system, by elimination with both pivots.
[[nodiscard]] Eigen::VectorXd elimination(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// The same of a symmetric matrix without negative (or without positive) eigenvalues.
[[nodiscard]] Eigen::VectorXd semidefinite_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// An orthonormal basis of what `a` sends to 0. @param threshold  of singular values, in the largest
[[nodiscard]] Eigen::MatrixXd kernel_of(const Eigen::MatrixXd& a, double threshold);

}  // namespace kreisel::core
