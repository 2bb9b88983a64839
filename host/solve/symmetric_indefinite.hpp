// symmetric_indefinite.hpp - dense symmetric systems of any inertia.
#pragma once

#include <Eigen/Dense>

namespace kreisel::core {

/// P A P^T = L D L^T with D of 1 x 1 and 2 x 2 blocks, by complete pivoting: the largest entry that is left
/// decides [Bunch, Parlett 1971]. For systems of a few to a few hundred rows; cost n^3 / 3 multiplications
/// and as many comparisons.
///
/// A is scaled first, on both sides alike, until the largest entries of its rows are within a factor of two
/// of 1: units do not decide which pivot is small.
///
/// @tparam Most  rows that A may have, so that none of it is on the heap; Eigen::Dynamic: any number
template <int Most = Eigen::Dynamic>
class SymmetricIndefinite {
 public:
  /// Factors `a`, of which the lower triangle is read.
  /// @return  false: singular to round-off, a pivot is below `2 n u` of the largest scaled entry (u: unit
  ///          round-off). Then solve() may not be called.
  bool factor(const Eigen::Ref<const Eigen::MatrixXd>& a);

  /// How many eigenvalues are negative: of D, so of A as well (Sylvester).
  [[nodiscard]] int negative() const { return negative_; }
  /// The smallest pivot over the largest entry of A, both scaled.
  [[nodiscard]] double smallest_pivot() const { return smallest_; }

  /// x = A^-1 x; one column a right-hand side.
  void solve(Eigen::Ref<Eigen::MatrixXd> x) const;

 private:
  void scale();
  [[nodiscard]] bool choose_pivot(Eigen::Index k);
  void exchange(Eigen::Index k, Eigen::Index p);
  [[nodiscard]] bool eliminate_one(Eigen::Index k);
  [[nodiscard]] bool eliminate_two(Eigen::Index k);

  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, Most, Most>;
  template <class T>
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1, Eigen::ColMajor, Most, 1>;

  Matrix a_;  ///< L below the blocks of D
  Vector<double> scale_;
  Vector<Eigen::Index> order_;
  Vector<bool> two_;  ///< whether a 2 x 2 block begins here
  int negative_ = 0;
  double smallest_ = 0;
};

}  // namespace kreisel::core
