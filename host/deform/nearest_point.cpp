#include "deform/nearest_point.hpp"

#include <algorithm>
#include <cmath>

namespace kreisel::core {

Eigen::MatrixXd HandleRows::columns() const {
  if (rows_.empty()) return {};
  Eigen::MatrixXd all(rows_.front().size(), size());
  for (Eigen::Index i = 0; i < size(); ++i) all.col(i) = rows_[static_cast<std::size_t>(i)];
  return all;
}

Eigen::VectorXd HandleRows::bounds() const {
  return Eigen::Map<const Eigen::VectorXd>(bounds_.data(), size());
}

Eigen::MatrixX3d nearest_point(const Eigen::MatrixXd& energy, const Eigen::MatrixX3d& centre,
                               const Eigen::MatrixX3d& slope, const HandleRows& rows, double penalty) {
  const Eigen::Index handles = centre.rows(), count = rows.size();
  const Eigen::LLT<Eigen::MatrixXd> inverse(energy);
  const Eigen::MatrixX3d free = centre - inverse.solve(slope);
  if (count == 0) return free;
  // Rows are scaled to one length in the metric, so that a sweep treats them alike.
  const Eigen::MatrixXd columns = rows.columns();
  Eigen::MatrixXd spread(3 * handles, count);  // energy^-1 rows^T
  for (int axis = 0; axis < 3; ++axis)
    spread.middleRows(axis * handles, handles) = inverse.solve(columns.middleRows(axis * handles, handles));
  const Eigen::MatrixXd gram = columns.transpose() * spread;
  const Eigen::VectorXd missed = columns.transpose() * free.reshaped() - rows.bounds();
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(count), slack = missed;  // missed - gram lambda
  // Gauss-Seidel, projected: the dual is convex, so it cannot but arrive; a step is worth a row.
  constexpr int most_sweeps = 1000;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double moved = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      if (!(gram(i, i) > 0)) continue;
      const double to = std::clamp(lambda[i] + slack[i] / gram(i, i), 0.0, penalty);
      const double by = to - lambda[i];
      if (by == 0) continue;
      lambda[i] = to;
      slack -= by * gram.col(i);
      moved = std::max(moved, std::abs(by) * std::sqrt(gram(i, i)));
    }
    if (moved < 1e-7) break;
  }
  const Eigen::VectorXd step = spread * lambda;
  return free - Eigen::Map<const Eigen::MatrixX3d>(step.data(), handles, 3);
}

}  // namespace kreisel::core
