#include "deform/biharmonic_weights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "deform/bounded_quadratic.hpp"
#include "deform/kept_weights.hpp"
#include "parallel.hpp"
#include "stop.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

/// w^T L M^-1 L w / 2.
class Biharmonic {
 public:
  explicit Biharmonic(const Cage& cage) : grid_(cage) {
    diagonal_.setZero(grid_.mass.size());
    for (Eigen::Index i = 0; i < diagonal_.size(); ++i)
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator e(grid_.L, i); e; ++e)
        diagonal_[e.col()] += e.value() * e.value() / grid_.mass[i];
  }
  [[nodiscard]] const Eigen::VectorXd& diagonal() const { return diagonal_; }
  void operator()(const Eigen::VectorXd& x, Eigen::VectorXd& out) const {
    const Eigen::VectorXd slope = (grid_.L * x).cwiseQuotient(grid_.mass);
    out.noalias() = grid_.L * slope;
  }

 private:
  GridLaplacian grid_;
  Eigen::VectorXd diagonal_;
};

}  // namespace

GridLaplacian::GridLaplacian(const Cage& cage) {
  const auto n = static_cast<Eigen::Index>(cage.nodes().size());
  mass.setZero(n);
  std::vector<Eigen::Triplet<double>> entries;
  for (const Cage::Place& cell : cage.cells()) {
    const auto corner = cage.corners(cell);
    for (std::size_t part = 0; part < 8; ++part) {
      mass[corner[part]] += 0.125;
      for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t other = part ^ (std::size_t{1} << a);
        entries.emplace_back(corner[part], corner[part], 0.25);
        entries.emplace_back(corner[part], corner[other], -0.25);
      }
    }
  }
  L.resize(n, n);
  L.setFromTriplets(entries.begin(), entries.end());
}

namespace {

/// Weights of all handles on one grid, a column each, not yet divided by their sums.
struct Solved {
  Eigen::MatrixXd weights;
  double residual = 0;
};

/// Of a coarser grid in the same cells, at the nodes of a finer one.
Eigen::MatrixXd interpolated(const Cage& coarse, const Eigen::MatrixXd& weights, const Cage& fine) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(fine.nodes().size()), weights.cols());
  for (std::size_t n = 0; n < fine.nodes().size(); ++n) {
    const Cage::Inside inside = coarse.inside(fine.position(fine.nodes()[n]));
    const auto corners = coarse.corners(inside.cell);
    const auto shares = inside.shares();
    auto row = result.row(static_cast<Eigen::Index>(n));
    row.setZero();
    for (std::size_t k = 0; k < 8; ++k) row += shares[k] * weights.row(corners[k]);
  }
  return result;
}

/// From coarse to fine: a grid of half the cells gives a start that is right but for its details.
Solved solved(const Cage& cage, const Control& control) {
  const auto n = static_cast<Eigen::Index>(cage.nodes().size());
  const auto count = static_cast<Eigen::Index>(cage.handles().size());
  Solved result;
  if (const int finer = cage.grid().finer; finer % 2 == 0) {
    const Cage coarse = cage.regridded(finer / 2);
    result.weights = interpolated(coarse, solved(coarse, control).weights, cage);
  } else {
    result.weights.setZero(n, count);
  }
  const Biharmonic form(cage);
  std::vector<double> residual(cage.handles().size());
  constexpr std::size_t batch = 16;  // between two words on how far it is
  for (std::size_t begin = 0; begin < residual.size(); begin += batch) {
    control.tell(fmt::format("weights on a grid of {} nodes, handle {} of {}", n, begin + 1, count));
    parallel_for(std::min(batch, residual.size() - begin), [&](std::size_t i) {
      const std::uint32_t own = cage.handles()[begin + i];
      Eigen::VectorXd lower = Eigen::VectorXd::Zero(n), upper = Eigen::VectorXd::Ones(n);
      for (const std::uint32_t handle : cage.handles()) upper[handle] = 0;
      lower[own] = upper[own] = 1;
      auto column = result.weights.col(static_cast<Eigen::Index>(begin + i));
      const BoundedMinimum found = bounded_minimum(form, form.diagonal(), lower, upper, column);
      column = found.x;
      residual[begin + i] = found.residual;
    });
  }
  result.residual = *std::ranges::max_element(residual);
  return result;
}

}  // namespace

BiharmonicWeights biharmonic_weights(const Cage& cage, const Control& control) {
  const Stopwatch watch;
  const StopScope scope(control.stop);
  const std::filesystem::path kept = kept_at(cage);
  if (auto weights = read_weights(kept, cage)) return std::move(*weights);
  const Solved all = solved(cage, control);
  BiharmonicWeights result;
  result.residual = all.residual;
  const Eigen::VectorXd sums = all.weights.rowwise().sum();
  result.sum_off = (sums.array() - 1).abs().maxCoeff();
  result.weights = (sums.cwiseInverse().asDiagonal() * all.weights).eval().sparseView();
  result.seconds = watch.seconds();
  write_weights(kept, result);
  return result;
}

}  // namespace kreisel::core
