// biharmonic_weights.hpp - how much each node of a cage's grid goes along with each handle.
#pragma once

#include <Eigen/SparseCore>

#include "control.hpp"
#include "deform/cage.hpp"

namespace kreisel::core {

/// One row a node, one column a handle.
using NodeWeights = Eigen::SparseMatrix<double, Eigen::RowMajor>;

struct BiharmonicWeights {
  NodeWeights weights;  ///< in [0, 1]; each row sums to 1; a handle has 1 of its own and 0 of all others
  double residual = 0;  ///< of the optimality conditions, the worst of all handles: see BoundedMinimum
  double sum_off = 0;   ///< by how much a node's weights missed 1 before they were divided by their sum
  double seconds = 0;   ///< that they took, 0 where they were kept on disk
};

/// Bounded biharmonic weights [Jacobson et al., Bounded biharmonic weights for real-time deformation, 2011]:
/// for each handle
///
///     minimise w^T L M^-1 L w,  0 <= w <= 1,  w = 1 at the handle and 0 at all others,
///
/// L the Laplacian of the grid with natural boundaries, M its masses. As there, each handle is solved for by
/// itself, and the weights of a node are divided by their sum. They are kept under device::cache_folder(),
/// keyed by the cage.
///
/// @throws Interrupted
[[nodiscard]] BiharmonicWeights biharmonic_weights(const Cage& cage, const Control& control = {});

/// The Laplacian of a cage's grid in units of its cells, and what of a cell each node has: a cell shared by
/// four edges a fourth each, by eight nodes an eighth.
struct GridLaplacian {
  explicit GridLaplacian(const Cage& cage);
  Eigen::SparseMatrix<double, Eigen::RowMajor> L;
  Eigen::VectorXd mass;
};

}  // namespace kreisel::core
