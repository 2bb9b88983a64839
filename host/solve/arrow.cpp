#include "solve/arrow.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "parallel.hpp"

namespace kreisel {
namespace {

/// Singles that are eliminated at a time: with some ten ties each they fill a core's first cache.
constexpr std::size_t chunk = 512;
/// Entries below which starting a thread takes longer than the work.
constexpr std::size_t worth_a_thread = 200'000;
/// What the elimination of a block is worth, measured in those.
constexpr std::size_t entries_a_block = 200;
/// More rows in the border than this are no help: the border costs the cube of their number.
constexpr std::size_t most_delayed = 256;

template <class Body>
void for_chunks(std::size_t count, std::size_t entries, const Body& body) {
  if (entries < worth_a_thread)
    for (std::size_t c = 0; c < count; ++c) body(c);
  else
    parallel_for(count, body);
}

std::size_t chunks_of(std::size_t count) { return (count + chunk - 1) / chunk; }

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

Eigen::Map<const Arrow::Matrix> Arrow::block_of(const Block& block) const {
  const auto n = static_cast<Eigen::Index>(block.rows.size());
  return {store_.data() + block.at, n, n};
}

Eigen::Map<const Arrow::Matrix> Arrow::ties_of(const Block& block) const {
  const auto n = static_cast<Eigen::Index>(block.rows.size());
  return {store_.data() + block.at + n * n, n, static_cast<Eigen::Index>(block.tied.size())};
}

bool Arrow::factor(std::span<const double> values, double growth) {
  for (const Run& run : runs_) {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(run.from);
    const auto to = store_.begin() + static_cast<std::ptrdiff_t>(run.to);
    const auto end = from + static_cast<std::ptrdiff_t>(run.count);
    if (run.first)
      std::copy(from, end, to);
    else
      std::transform(from, end, to, to, std::plus{});
  }
  negative_ = 0;
  delayed_.clear();
  const auto border = static_cast<Eigen::Index>(shape_.border.size());
  border_ = Eigen::Map<const Matrix>(store_.data() + border_at_, border, border);
  Matrix schur = border_;
  eliminate_singles(growth, schur);
  eliminate_blocks(growth, schur);
  if (delayed_.size() > most_delayed) return false;
  extend_border(schur);
  if (!schur_.factor(schur)) return false;
  negative_ += schur_.negative();
  border_ = border_.selfadjointView<Eigen::Lower>();
  return true;
}

void Arrow::eliminate_singles(double growth, Matrix& schur) {
  struct Part {
    Matrix sum;
    int negative = 0;
    std::vector<int> late;
  };
  const std::size_t singles = shape_.singles.size();
  const auto ties = static_cast<Eigen::Index>(tied_.size());
  inverse_.resize(static_cast<Eigen::Index>(singles));
  std::vector<Part> parts(chunks_of(shape_.singles.size()));
  for_chunks(parts.size(), singles * tied_.size(), [&](std::size_t c) {
    Part& part = parts[c];
    const std::size_t first = c * chunk;
    const auto count = static_cast<Eigen::Index>(std::min(chunk, singles - first));
    const Eigen::Map<const Eigen::ArrayXd> pivots(store_.data() + first, count);
    const Eigen::Map<const Matrix, 0, Eigen::OuterStride<>> f(
        store_.data() + singles + first, count, ties,
        Eigen::OuterStride<>(static_cast<Eigen::Index>(singles)));
    auto inverse = inverse_.segment(static_cast<Eigen::Index>(first), count);
    Eigen::ArrayXd largest = Eigen::ArrayXd::Zero(count);
    for (Eigen::Index k = 0; k < ties; ++k) largest = largest.max(f.col(k).array().abs());
    for (Eigen::Index i = 0; i < count; ++i) {
      const bool early = pivots[i] != 0 && std::abs(pivots[i]) * growth >= largest[i];
      inverse[i] = early ? 1 / pivots[i] : 0.0;
      if (!early) part.late.push_back(static_cast<int>(first) + static_cast<int>(i));
      part.negative += early && pivots[i] < 0;
    }
    part.sum.resize(ties, ties);
    for (Eigen::Index b = 0; b < ties; ++b) {
      const Vector scaled = inverse.cwiseProduct(f.col(b));
      for (Eigen::Index a = b; a < ties; ++a) part.sum(a, b) = scaled.dot(f.col(a));
    }
  });
  late_.clear();
  for (const Part& part : parts) {
    negative_ += part.negative;
    late_.insert(late_.end(), part.late.begin(), part.late.end());
    for (Eigen::Index b = 0; b < ties; ++b)
      for (Eigen::Index a = b; a < ties; ++a)
        schur(tied_[static_cast<std::size_t>(a)], tied_[static_cast<std::size_t>(b)]) -= part.sum(a, b);
  }
  for (const int i : late_) delayed_.push_back(shape_.singles[at(i)]);
}

void Arrow::eliminate_blocks(double growth, Matrix& schur) {
  struct Part {
    Matrix sum;
    int negative = 0;
  };
  std::vector<Part> parts(chunks_of(blocks_.size()));
  for_chunks(parts.size(), blocks_.size() * entries_a_block, [&](std::size_t c) {
    Part& part = parts[c];
    part.sum = Matrix::Zero(schur.rows(), schur.cols());
    for (Block& block : std::span(blocks_).subspan(c * chunk, std::min(chunk, blocks_.size() - c * chunk))) {
      block.solved = ties_of(block);
      block.delayed = !block.inverse.factor(block_of(block));
      if (!block.delayed && block.solved.size() > 0) {
        block.inverse.solve(block.solved);
        block.delayed = !(block.solved.cwiseAbs().maxCoeff() <= growth);
      }
      if (block.delayed) continue;
      part.negative += block.inverse.negative();
      const auto ties = ties_of(block);
      for (Eigen::Index b = 0; b < ties.cols(); ++b)
        for (Eigen::Index a = b; a < ties.cols(); ++a)
          part.sum(block.tied[static_cast<std::size_t>(a)], block.tied[static_cast<std::size_t>(b)]) +=
              ties.col(a).dot(block.solved.col(b));
    }
  });
  for (const Part& part : parts) {
    negative_ += part.negative;
    schur -= part.sum;
  }
  for (const Block& block : blocks_)
    if (block.delayed) delayed_.insert(delayed_.end(), block.rows.begin(), block.rows.end());
}

void Arrow::extend_border(Matrix& schur) {
  if (delayed_.empty()) return;
  const Eigen::Index before = border_.rows(), all = before + static_cast<Eigen::Index>(delayed_.size());
  for (Matrix* m : {&border_, &schur}) {
    m->conservativeResize(all, all);
    m->bottomRows(all - before).setZero();
    m->rightCols(all - before).setZero();
  }
  Eigen::Index row = before;
  const auto put = [&](Eigen::Index i, Eigen::Index j, double value) { border_(i, j) = schur(i, j) = value; };
  const std::size_t singles = shape_.singles.size();
  for (const int i : late_) {
    put(row, row, store_[at(i)]);
    for (std::size_t k = 0; k < tied_.size(); ++k) put(row, tied_[k], store_[(1 + k) * singles + at(i)]);
    ++row;
  }
  for (const Block& block : blocks_) {
    if (!block.delayed) continue;
    const auto own = block_of(block), ties = ties_of(block);
    for (Eigen::Index i = 0; i < own.rows(); ++i, ++row) {
      for (Eigen::Index j = 0; j <= i; ++j) put(row, row - i + j, own(i, j));
      for (Eigen::Index k = 0; k < ties.cols(); ++k)
        put(row, block.tied[static_cast<std::size_t>(k)], ties(i, k));
    }
  }
}

void Arrow::add_behind(const Block& block, std::span<const double> r, const Vector& y, std::span<double> x,
                       Vector& sum) const {
  const auto ties = ties_of(block);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, arrow_block, 1> part(ties.rows(), 1);
  for (Eigen::Index k = 0; k < ties.rows(); ++k) part(k) = r[at(block.rows[static_cast<std::size_t>(k)])];
  for (Eigen::Index k = 0; k < ties.cols(); ++k)
    part -= ties.col(k) * y[block.tied[static_cast<std::size_t>(k)]];
  block.inverse.solve(part);
  for (Eigen::Index k = 0; k < ties.rows(); ++k) x[at(block.rows[static_cast<std::size_t>(k)])] = part(k);
  for (Eigen::Index k = 0; k < ties.cols(); ++k)
    sum[block.tied[static_cast<std::size_t>(k)]] += ties.col(k).dot(part.col(0));
}

/// x = D^-1 (r - F^T y) of all rows that are not in the extended border.
/// @return  F x
Arrow::Vector Arrow::behind_border(std::span<const double> r, const Vector& y, std::span<double> x) const {
  const std::size_t singles = shape_.singles.size();
  const auto ties = static_cast<Eigen::Index>(tied_.size());
  const Vector y_tied = y(tied_);
  std::vector<Vector> parts(chunks_of(shape_.singles.size()));
  for_chunks(parts.size(), singles * tied_.size(), [&](std::size_t c) {
    const std::size_t first = c * chunk;
    const auto count = static_cast<Eigen::Index>(std::min(chunk, singles - first));
    const Eigen::Map<const Matrix, 0, Eigen::OuterStride<>> f(
        store_.data() + singles + first, count, ties,
        Eigen::OuterStride<>(static_cast<Eigen::Index>(singles)));
    const auto rows = std::span(shape_.singles).subspan(first, static_cast<std::size_t>(count));
    Vector part(count);
    for (Eigen::Index i = 0; i < count; ++i) part[i] = r[at(rows[static_cast<std::size_t>(i)])];
    part.noalias() -= f * y_tied;
    part.array() *= inverse_.segment(static_cast<Eigen::Index>(first), count).array();
    for (Eigen::Index i = 0; i < count; ++i) x[at(rows[static_cast<std::size_t>(i)])] = part[i];
    parts[c].noalias() = f.transpose() * part;
  });
  Vector sum = Vector::Zero(y.size());
  for (const Vector& part : parts) sum(tied_) += part;
  std::vector<Vector> of_blocks(chunks_of(blocks_.size()));
  for_chunks(of_blocks.size(), blocks_.size() * entries_a_block, [&](std::size_t c) {
    Vector& part = of_blocks[c] = Vector::Zero(y.size());
    for (const Block& block :
         std::span(blocks_).subspan(c * chunk, std::min(chunk, blocks_.size() - c * chunk)))
      if (!block.delayed) add_behind(block, r, y, x, part);
  });
  for (const Vector& part : of_blocks) sum += part;
  return sum;
}

void Arrow::solve(std::span<double> x) const {
  const std::vector<double> r(x.begin(), x.end());
  std::vector<int> border = shape_.border;
  border.insert(border.end(), delayed_.begin(), delayed_.end());
  const Vector right = Eigen::Map<const Vector>(r.data(), size_)(border);
  Matrix y = Vector::Zero(right.size());
  const Vector front = behind_border(r, y, x);
  Matrix missing = right - front;
  // Where it is what the sums above leave of their terms, there is nothing to be gained.
  constexpr double round_off = 1e-13;
  const double size = (right.cwiseAbs() + front.cwiseAbs()).lpNorm<Eigen::Infinity>();
  double before = std::numeric_limits<double>::infinity();
  for (double now = missing.lpNorm<Eigen::Infinity>(); now > round_off * size && now < before / 2;
       now = missing.lpNorm<Eigen::Infinity>()) {
    before = now;
    schur_.solve(missing);
    y += missing;
    missing = right - border_ * y - behind_border(r, y, x);
  }
  Eigen::Map<Vector>(x.data(), size_)(border) = y.col(0);
}

}  // namespace kreisel
