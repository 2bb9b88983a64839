// nearest_point.hpp - the nearest displacements of handles that meet linear rows.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace kreisel::core {

/// Rows a . u <= b on all displacements of K handles, u = (x of all, y of all, z of all).
class HandleRows {
 public:
  /// @param a  (K, 3)
  void add(const Eigen::MatrixX3d& a, double b) {
    rows_.emplace_back(a.reshaped());
    bounds_.push_back(b);
  }
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(rows_.size()); }
  /// (3 K, rows)
  [[nodiscard]] Eigen::MatrixXd columns() const;
  [[nodiscard]] Eigen::VectorXd bounds() const;

 private:
  std::vector<Eigen::VectorXd> rows_;
  std::vector<double> bounds_;
};

/// Minimises |u - centre|^2 / 2 in the metric of `energy`, the same along each axis, plus slope . u, where
/// the rows hold. By the dual: as many unknowns as there are rows, each of them between 0 and `penalty`. Rows
/// that contradict each other so end in a compromise, with what they are missed by at that price.
///
/// @param energy  (K, K), symmetric and positive definite  @param slope  (K, 3), zero where there is none
/// @return        (K, 3)
[[nodiscard]] Eigen::MatrixX3d nearest_point(const Eigen::MatrixXd& energy, const Eigen::MatrixX3d& centre,
                                             const Eigen::MatrixX3d& slope, const HandleRows& rows,
                                             double penalty);

}  // namespace kreisel::core
