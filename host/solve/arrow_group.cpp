#include "solve/arrow_group.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "parallel.hpp"
#include "solve/arrow_shape.hpp"
#include "solve/symmetric_indefinite.hpp"

namespace kreisel::core {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Lane = Eigen::Map<const ArrayXd>;

/// Rows that are eliminated at a time: with some ten ties each they fill a core's first cache.
constexpr std::size_t rows_at_a_time = 512;
/// Entries below which starting a thread takes longer than the work.
constexpr std::size_t worth_a_thread = 200'000;

/// Entries of a lower triangle of arrow_block rows.
constexpr std::size_t triangle_of_largest = arrow_block * (arrow_block + 1) / 2;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// @return  negative eigenvalues; nothing where |tie / pivot| is larger than growth
std::optional<int> invert_single(double& pivot, double growth, double tie) {
  if (!(pivot != 0 && tie <= growth * std::abs(pivot))) return {};
  pivot = 1 / pivot;
  return pivot < 0;
}

/// @param ties  the largest of each row's ties
std::optional<int> invert_block(std::array<double, triangle_of_largest>& lower, int rows, double growth,
                                const Eigen::Ref<const Eigen::RowVectorXd, 0, Eigen::InnerStride<>>& ties) {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, arrow_block, arrow_block> a(rows,
                                                                                                     rows);
  for (int i = 0, e = 0; i < rows; ++i)
    for (int j = 0; j <= i; ++j) a(i, j) = lower[at(e++)];
  SymmetricIndefinite<arrow_block> factors;
  if (!factors.factor(a)) return {};
  a.setIdentity();
  factors.solve(a);
  if (!(a.cwiseAbs().colwise().maxCoeff().cwiseProduct(ties).maxCoeff() <= growth)) return {};
  for (int i = 0, e = 0; i < rows; ++i)
    for (int j = 0; j <= i; ++j) lower[at(e++)] = a(i, j);
  return factors.negative();
}

}  // namespace

/// Blocks beside each other.
struct ArrowGroup::Chunk {
  std::size_t first, count;
};

/// What a chunk leaves for the sum over all of them.
struct ArrowGroup::Part {
  Matrix sum;
  int negative = 0;
  std::vector<std::size_t> delayed;
};

ArrowGroup::ArrowGroup(int rows, const std::vector<int>& blocks)
    : rows_(rows), count_(blocks.size() / at(rows)), index_(blocks.size()) {
  for (std::size_t b = 0; b < count_; ++b)
    for (std::size_t i = 0; i < at(rows); ++i) index_[i * count_ + b] = blocks[b * at(rows) + i];
}

std::size_t ArrowGroup::lay_out(std::vector<int> tied, std::size_t begin) {
  tied_ = std::move(tied);
  begin_ = begin;
  inverse_.resize(triangle(rows_, 0) * count_);
  return begin_ + (triangle(rows_, 0) + at(rows_) * tied_.size()) * count_;
}

/// Place of (i, j), either of which may be the larger, in a lower triangle that is stored row by row.
std::size_t ArrowGroup::triangle(int i, int j) {
  const std::size_t row = at(std::max(i, j)), column = at(std::min(i, j));
  return row * (row + 1) / 2 + column;
}

std::size_t ArrowGroup::own(std::size_t block, int i, int j) const {
  return begin_ + triangle(i, j) * count_ + block;
}

std::size_t ArrowGroup::tie(std::size_t block, int i, int place) const {
  return nth_tie(block, i, std::ranges::lower_bound(tied_, place) - tied_.begin());
}

std::size_t ArrowGroup::nth_tie(std::size_t block, int i, std::ptrdiff_t k) const {
  return begin_ + (triangle(rows_, 0) + at(i) * tied_.size() + static_cast<std::size_t>(k)) * count_ + block;
}

std::size_t ArrowGroup::chunks() const {
  const std::size_t blocks = rows_at_a_time / at(rows_);
  return (count_ + blocks - 1) / blocks;
}

template <class Body>
void ArrowGroup::for_chunks(const Body& body) const {
  const std::size_t blocks = rows_at_a_time / at(rows_), all = chunks();
  const auto one = [&](std::size_t c) { body(c, Chunk{c * blocks, std::min(blocks, count_ - c * blocks)}); };
  if (index_.size() * tied_.size() < worth_a_thread)
    for (std::size_t c = 0; c < all; ++c) one(c);
  else
    parallel_for(all, one);
}

int ArrowGroup::eliminate(std::span<const double> store, double growth, Matrix& schur) {
  std::vector<Part> parts(chunks());
  for_chunks([&](std::size_t c, const Chunk& chunk) {
    invert(store, chunk, growth, parts[c]);
    sum_up(store, chunk, parts[c].sum);
  });
  delayed_.clear();
  int negative = 0;
  for (const Part& part : parts) {
    negative += part.negative;
    delayed_.insert(delayed_.end(), part.delayed.begin(), part.delayed.end());
    for (Index b = 0; b < part.sum.cols(); ++b)
      for (Index a = b; a < part.sum.rows(); ++a)
        schur(tied_[static_cast<std::size_t>(a)], tied_[static_cast<std::size_t>(b)]) -= part.sum(a, b);
  }
  return negative;
}

/// A block's largest entry of |D^-1 F^T| is bounded by those of its inverse's columns times those of its rows
/// of F: the price is that a block may be delayed that need not be.
void ArrowGroup::invert(std::span<const double> store, const Chunk& chunk, double growth, Part& part) {
  const auto count = static_cast<Index>(chunk.count);
  Matrix ties = Matrix::Zero(count, rows_);
  for (int i = 0; i < rows_; ++i)
    for (Index k = 0; k < static_cast<Index>(tied_.size()); ++k)
      ties.col(i) = ties.col(i).array().max(Lane(store.data() + nth_tie(chunk.first, i, k), count).abs());
  const std::size_t triangles = triangle(rows_, 0);
  for (Index b = 0; b < count; ++b) {
    const std::size_t number = chunk.first + static_cast<std::size_t>(b);
    std::array<double, triangle_of_largest> block;
    for (std::size_t e = 0; e < triangles; ++e) block[e] = store[begin_ + e * count_ + number];
    const auto negative = rows_ == 1 ? invert_single(block[0], growth, ties(b, 0))
                                     : invert_block(block, rows_, growth, ties.row(b));
    part.negative += negative.value_or(0);
    if (!negative) {
      part.delayed.push_back(number);
      block.fill(0);
    }
    for (std::size_t e = 0; e < triangles; ++e) inverse_[e * count_ + number] = block[e];
  }
}

void ArrowGroup::sum_up(std::span<const double> store, const Chunk& chunk, Matrix& sum) const {
  const auto count = static_cast<Index>(chunk.count), ties = static_cast<Index>(tied_.size());
  const auto f = [&](int i, Index k) { return Lane(store.data() + nth_tie(chunk.first, i, k), count); };
  sum.setZero(ties, ties);
  ArrayXd scaled(count);
  for (int i = 0; i < rows_; ++i)
    for (Index b = 0; b < ties; ++b) {
      scaled.setZero();
      for (int j = 0; j < rows_; ++j)
        scaled += Lane(inverse_.data() + triangle(i, j) * count_ + chunk.first, count) * f(j, b);
      for (Index a = b; a < ties; ++a) sum(a, b) += (scaled * f(i, a)).sum();
    }
}

void ArrowGroup::behind_border(std::span<const double> store, std::span<const double> r, const Vector& y,
                               std::span<double> x, Vector& sum) const {
  const auto ties = static_cast<Index>(tied_.size());
  const Vector tied = y(tied_);
  std::vector<Vector> parts(chunks());
  for_chunks([&](std::size_t c, const Chunk& chunk) {
    const auto count = static_cast<Index>(chunk.count);
    const auto f = [&](int i) {
      return Eigen::Map<const Matrix, 0, Eigen::OuterStride<>>(
          store.data() + nth_tie(chunk.first, i, 0), count, ties,
          Eigen::OuterStride<>(static_cast<Index>(count_)));
    };
    const auto lane = [&](const double* of, int i, int j) {
      return Lane(of + triangle(i, j) * count_ + chunk.first, count);
    };
    Matrix right(count, rows_), part = Matrix::Zero(count, rows_);
    for (int i = 0; i < rows_; ++i) {
      const int* rows = index_.data() + at(i) * count_ + chunk.first;
      for (Index b = 0; b < count; ++b) right(b, i) = r[at(rows[b])];
      right.col(i).noalias() -= f(i) * tied;
    }
    const auto add_inverse = [&] {
      for (int i = 0; i < rows_; ++i)
        for (int j = 0; j < rows_; ++j)
          part.col(i).array() += lane(inverse_.data(), i, j) * right.col(j).array();
    };
    add_inverse();
    if (rows_ > 1) {
      for (int i = 0; i < rows_; ++i)
        for (int j = 0; j < rows_; ++j)
          right.col(i).array() -= lane(store.data() + begin_, i, j) * part.col(j).array();
      add_inverse();
    }
    parts[c] = Vector::Zero(ties);
    for (int i = 0; i < rows_; ++i) {
      const int* rows = index_.data() + at(i) * count_ + chunk.first;
      for (Index b = 0; b < count; ++b) x[at(rows[b])] = part(b, i);
      parts[c].noalias() += f(i).transpose() * part.col(i);
    }
  });
  for (const Vector& part : parts) sum(tied_) += part;
}

}  // namespace kreisel::core
