// arrow.hpp - linear systems whose matrix is a diagonal, or small blocks, with a few dense rows.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "solve/arrow_group.hpp"
#include "solve/arrow_shape.hpp"
#include "solve/symmetric_indefinite.hpp"

namespace kreisel::core {

/// Solves K x = r for a symmetric K with the shape of an arrow (ArrowShape), of any inertia:
///
///     K = [ D   F^T ]     S = B - F D^-1 F^T,     y = S^-1 (r_B - F D^-1 r_D),     x_D = D^-1 (r_D - F^T y)
///         [ F   B   ]
///
/// D is eliminated in vectors, on all threads where that pays; what is left, S, by SymmetricIndefinite. By
/// Haynsworth the negative eigenvalues of K are those of D and those of S.
///
/// Pivots of D that are small against their column of F would drown what the others leave in S. Such rows are
/// eliminated with the border instead ("delayed"), as sparse solvers do.
///
/// Cost, n rows in D and k of the border tied to them: n k (k + 3) / 2 multiplications a factorisation, 4 n k
/// a solve; 8 n (k + 1) bytes are read once a factorisation and twice a solve. Results do not depend on the
/// number of threads.
class Arrow {
 public:
  /// @return  nothing where the pattern is not an arrow's
  [[nodiscard]] static std::unique_ptr<Arrow> of(const Pattern& pattern);
  Arrow(const Pattern& pattern, const ArrowShape& shape);

  /// @param values  of the pattern's entries, in its order; those of one place are summed
  /// @param growth  rows are delayed where |D^-1 F^T| is larger than this
  /// @return        false: K is singular; solve() may not be called
  [[nodiscard]] bool factor(std::span<const double> values, double growth = 1e8);

  /// Negative eigenvalues of the matrix that was last factored.
  [[nodiscard]] int negative() const { return negative_; }
  /// Rows that the last factorisation delayed.
  [[nodiscard]] std::size_t delayed() const { return delayed_.size(); }
  [[nodiscard]] int size() const { return size_; }

  /// x = K^-1 x, refined as long as the border's residual is more than round-off and halves; as a rule once
  /// or not at all. Rows before the border are solved to round-off as they are.
  void solve(std::span<double> x) const;

 private:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;
  /// Entries that lie beside each other in the caller's array and in store_.
  struct Run {
    std::size_t from, to, count;
    bool first;  ///< that are written there; others are added
  };
  void lay_out(const Pattern& pattern);
  void extend_border(Matrix& schur);
  [[nodiscard]] Vector behind_border(std::span<const double> r, const Vector& y, std::span<double> x) const;

  int size_;
  std::vector<int> own_border_;     ///< as the shape has it
  std::vector<ArrowGroup> groups_;  ///< D and F
  std::vector<Run> runs_;
  std::vector<double> store_;  ///< the groups'; B
  std::size_t border_at_ = 0;  ///< in store_
  std::vector<int> delayed_;   ///< rows of K that the last factorisation has behind the border, in S
  Matrix border_;              ///< B and the delayed rows
  SymmetricIndefinite<> schur_;
  int negative_ = 0;
};

}  // namespace kreisel::core
