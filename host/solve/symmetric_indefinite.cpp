#include "solve/symmetric_indefinite.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solve/arrow_shape.hpp"

namespace kreisel::core {
namespace {

using Eigen::Index;

/// A 1 x 1 pivot is taken when it is this share of the largest entry: the growth of entries over one 2 x 2
/// step is then that of two 1 x 1 steps. [Bunch, Parlett 1971]
const double share = (1 + std::sqrt(17.0)) / 8;

/// What sums of n products of numbers that are at most 1 may leave where there should be nothing.
double round_off(Index n) { return static_cast<double>(n) * std::numeric_limits<double>::epsilon(); }

}  // namespace

/// Each sweep takes the square root of how far the rows' largest entries lie apart [Ruiz 2001].
template <int Most>
void SymmetricIndefinite<Most>::scale() {
  const Index n = a_.rows();
  scale_.setOnes(n);
  // The range of a double's exponents, to within a factor of two. Small ones are many, and their rows alike:
  // one sweep leaves no entry above 1.
  constexpr int most_sweeps = Most == Eigen::Dynamic ? 16 : 1;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    Vector<double> largest = Vector<double>::Zero(n);
    for (Index j = 0; j < n; ++j)
      for (Index i = j; i < n; ++i) {
        const double size = std::abs(a_(i, j));
        largest[i] = std::max(largest[i], size);
        largest[j] = std::max(largest[j], size);
      }
    bool even = true;
    for (double& size : largest) {
      even = even && (size == 0 || (size > 0.5 && size < 2));
      size = size > 0 ? 1 / std::sqrt(size) : 1;
    }
    if (even) return;
    scale_.array() *= largest.array();
    for (Index j = 0; j < n; ++j)
      for (Index i = j; i < n; ++i) a_(i, j) *= largest[i] * largest[j];
  }
}

template <int Most>
bool SymmetricIndefinite<Most>::choose_pivot(Index k) {
  const Index n = a_.rows();
  Index largest = k, row = k, column = k;
  double diagonal = -1, off = -1;
  for (Index j = k; j < n; ++j) {
    if (std::abs(a_(j, j)) > diagonal) diagonal = std::abs(a_(largest = j, j));
    for (Index i = j + 1; i < n; ++i)
      if (std::abs(a_(i, j)) > off) off = std::abs(a_(row = i, column = j));
  }
  if (diagonal >= share * off) {
    exchange(k, largest);
    return false;
  }
  exchange(k, column);  // column < row, so this does not move the row
  exchange(k + 1, row);
  return true;
}

template <int Most>
void SymmetricIndefinite<Most>::exchange(Index k, Index p) {
  if (p == k) return;
  const Index n = a_.rows();
  std::swap(order_[k], order_[p]);
  std::swap(a_(k, k), a_(p, p));
  for (Index j = 0; j < k; ++j) std::swap(a_(k, j), a_(p, j));
  for (Index j = k + 1; j < p; ++j) std::swap(a_(j, k), a_(p, j));
  for (Index i = p + 1; i < n; ++i) std::swap(a_(i, k), a_(i, p));
}

template <int Most>
bool SymmetricIndefinite<Most>::eliminate_one(Index k) {
  const double pivot = a_(k, k);
  smallest_ = std::min(smallest_, std::abs(pivot));
  if (!(std::abs(pivot) > round_off(a_.rows()))) return false;
  negative_ += pivot < 0;
  const Index left = a_.rows() - k - 1;
  const Vector<double> row = a_.col(k).tail(left);
  a_.col(k).tail(left) /= pivot;
  for (Index j = 0; j < left; ++j) a_.col(k + 1 + j).tail(left - j) -= row[j] * a_.col(k).tail(left - j);
  return true;
}

template <int Most>
bool SymmetricIndefinite<Most>::eliminate_two(Index k) {
  Eigen::Matrix2d block;
  block << a_(k, k), a_(k + 1, k), a_(k + 1, k), a_(k + 1, k + 1);
  // The off-diagonal is the larger by choice, so one eigenvalue is positive and one negative.
  const double size = std::abs(a_(k + 1, k));
  smallest_ = std::min(smallest_, size);
  if (!(size > round_off(a_.rows()))) return false;
  ++negative_;
  const Index left = a_.rows() - k - 2;
  const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::ColMajor, Most, 2> rows = a_.block(k + 2, k, left, 2);
  a_.block(k + 2, k, left, 2) = rows * block.inverse();
  for (Index j = 0; j < left; ++j)
    a_.col(k + 2 + j).tail(left - j) -= a_.block(k + 2 + j, k, left - j, 2) * rows.row(j).transpose();
  return true;
}

template <int Most>
bool SymmetricIndefinite<Most>::factor(const Eigen::Ref<const Eigen::MatrixXd>& a) {
  a_ = a;
  const Index n = a_.rows();
  negative_ = 0;
  smallest_ = n > 0 ? INFINITY : 1;
  order_ = Vector<Index>::LinSpaced(n, 0, n - 1);
  two_.setConstant(n, false);
  scale();
  for (Index k = 0; k < n;) {
    const bool two = choose_pivot(k);
    two_[k] = two;
    if (!(two ? eliminate_two(k) : eliminate_one(k))) return false;
    k += two ? 2 : 1;
  }
  return true;
}

template <int Most>
void SymmetricIndefinite<Most>::solve(Eigen::Ref<Eigen::MatrixXd> x) const {
  const Index n = a_.rows();
  Vector<double> y(n);
  for (Index c = 0; c < x.cols(); ++c) {
    for (Index i = 0; i < n; ++i) y[i] = x(order_[i], c) * scale_[order_[i]];
    for (Index k = 0; k < n; k += two_[k] ? 2 : 1) {
      const Index width = two_[k] ? 2 : 1, left = n - k - width;
      for (Index l = k; l < k + width; ++l) y.tail(left) -= y[l] * a_.col(l).tail(left);
    }
    for (Index k = 0; k < n; k += two_[k] ? 2 : 1) {
      if (!two_[k]) {
        y[k] /= a_(k, k);
        continue;
      }
      Eigen::Matrix2d block;
      block << a_(k, k), a_(k + 1, k), a_(k + 1, k), a_(k + 1, k + 1);
      y.template segment<2>(k) = block.inverse() * y.template segment<2>(k).eval();
    }
    for (Index k = n; k > 0;) {
      const Index width = k > 1 && two_[k - 2] ? 2 : 1, left = n - k;
      k -= width;
      for (Index l = k; l < k + width; ++l) y[l] -= a_.col(l).tail(left).dot(y.tail(left));
    }
    for (Index i = 0; i < n; ++i) x(order_[i], c) = y[i] * scale_[order_[i]];
  }
}

template class SymmetricIndefinite<Eigen::Dynamic>;
template class SymmetricIndefinite<arrow_block>;

}  // namespace kreisel::core
