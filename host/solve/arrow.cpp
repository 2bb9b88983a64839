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
/// More rows in the border than this are no help: the border costs the cube of their number.
constexpr std::size_t most_delayed = 256;

template <class Body>
void for_chunks(std::size_t count, std::size_t entries, const Body& body) {
  if (entries < worth_a_thread)
    for (std::size_t c = 0; c < count; ++c) body(c);
  else
    parallel_for(count, body);
}

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Where each row of K is.
struct Place {
  enum { border, single, block } kind = border;
  int index = 0, in_block = 0;
};

std::vector<Place> places_of(int size, const ArrowShape& shape) {
  std::vector<Place> places(at(size));
  const auto number = [&](const std::vector<int>& rows, decltype(Place::kind) kind) {
    for (std::size_t k = 0; k < rows.size(); ++k) places[at(rows[k])] = {kind, static_cast<int>(k), 0};
  };
  number(shape.border, Place::border);
  number(shape.singles, Place::single);
  for (std::size_t b = 0; b < shape.blocks.size(); ++b)
    for (std::size_t k = 0; k < shape.blocks[b].size(); ++k)
      places[at(shape.blocks[b][k])] = {Place::block, static_cast<int>(b), static_cast<int>(k)};
  return places;
}

/// The pair of an entry with the one nearer to the border last.
std::pair<Place, Place> ordered(const std::vector<Place>& places, const Pattern& p, std::size_t e) {
  Place a = places[at(p.rows[e] - p.base)], b = places[at(p.columns[e] - p.base)];
  if (a.kind == Place::border && b.kind != Place::border) std::swap(a, b);
  return {a, b};
}

void add_once(std::vector<int>& all, int value) {
  if (const auto where = std::ranges::lower_bound(all, value); where == all.end() || *where != value)
    all.insert(where, value);
}

std::size_t position(const std::vector<int>& all, int value) {
  return static_cast<std::size_t>(std::ranges::lower_bound(all, value) - all.begin());
}

}  // namespace

std::unique_ptr<Arrow> Arrow::of(const Pattern& pattern) {
  auto shape = ArrowShape::of(pattern);
  return shape ? std::make_unique<Arrow>(pattern, std::move(*shape)) : nullptr;
}

Arrow::Arrow(const Pattern& pattern, ArrowShape shape) : size_(pattern.size), shape_(std::move(shape)) {
  for (std::vector<int>& rows : shape_.blocks) blocks_.push_back({rows, {}, 0});
  lay_out(pattern);
}

void Arrow::lay_out(const Pattern& pattern) {
  const std::vector<Place> places = places_of(size_, shape_);
  const std::size_t entries = pattern.rows.size();
  std::vector<char> tied(shape_.border.size());
  for (std::size_t e = 0; e < entries; ++e)
    if (const auto [a, b] = ordered(places, pattern, e); b.kind == Place::border) {
      if (a.kind == Place::single) tied[at(b.index)] = 1;
      if (a.kind == Place::block) add_once(blocks_[at(a.index)].tied, b.index);
    }
  for (std::size_t k = 0; k < tied.size(); ++k)
    if (tied[k]) tied_.push_back(static_cast<int>(k));

  const std::size_t singles = shape_.singles.size(), border = shape_.border.size();
  border_at_ = singles * (1 + tied_.size());
  std::size_t end = border_at_ + border * border;
  for (Block& block : blocks_) {
    block.at = end;
    end += block.rows.size() * (block.rows.size() + block.tied.size());
  }
  store_.resize(end);

  const auto slot = [&](std::size_t e) {
    const auto [a, b] = ordered(places, pattern, e);
    if (a.kind == Place::border)
      return border_at_ + at(std::min(a.index, b.index)) * border + at(std::max(a.index, b.index));
    if (a.kind == Place::single)
      return at(a.index) + (b.kind == Place::border ? (1 + position(tied_, b.index)) * singles : 0);
    const Block& block = blocks_[at(a.index)];
    const std::size_t rows = block.rows.size();
    const std::size_t column =
        b.kind == Place::border ? rows + position(block.tied, b.index) : at(std::min(a.in_block, b.in_block));
    const int row = b.kind == Place::border ? a.in_block : std::max(a.in_block, b.in_block);
    return block.at + column * rows + at(row);
  };
  std::vector<bool> written(end);
  for (std::size_t e = 0; e < entries; ++e) {
    const std::size_t to = slot(e);
    const bool first = !written[to];
    written[to] = true;
    if (!runs_.empty() && runs_.back().first == first && runs_.back().to + runs_.back().count == to)
      ++runs_.back().count;
    else
      runs_.push_back({e, to, 1, first});
  }
}

Eigen::Map<const Arrow::Matrix> Arrow::block_of(const Block& block) const {
  const auto n = static_cast<Eigen::Index>(block.rows.size());
  return {store_.data() + block.at, n, n};
}

Eigen::Map<const Arrow::Matrix> Arrow::ties_of(const Block& block) const {
  const auto n = static_cast<Eigen::Index>(block.rows.size());
  return {store_.data() + block.at + n * n, n, static_cast<Eigen::Index>(block.tied.size())};
}

std::size_t Arrow::chunk_count() const { return (shape_.singles.size() + chunk - 1) / chunk; }

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
  std::vector<Part> parts(chunk_count());
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
  for (Block& block : blocks_) {
    block.solved = ties_of(block);
    block.delayed = !block.inverse.factor(block_of(block));
    if (!block.delayed && block.solved.size() > 0) {
      block.inverse.solve(block.solved);
      block.delayed = !(block.solved.cwiseAbs().maxCoeff() <= growth);
    }
    if (block.delayed) {
      delayed_.insert(delayed_.end(), block.rows.begin(), block.rows.end());
      continue;
    }
    negative_ += block.inverse.negative();
    const Matrix sum = ties_of(block).transpose() * block.solved;
    for (Eigen::Index b = 0; b < sum.cols(); ++b)
      for (Eigen::Index a = b; a < sum.rows(); ++a)
        schur(block.tied[static_cast<std::size_t>(a)], block.tied[static_cast<std::size_t>(b)]) -= sum(a, b);
  }
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

/// x = D^-1 (r - F^T y) of all rows that are not in the extended border.
/// @return  F x
Arrow::Vector Arrow::behind_border(std::span<const double> r, const Vector& y, std::span<double> x) const {
  const std::size_t singles = shape_.singles.size();
  const auto ties = static_cast<Eigen::Index>(tied_.size());
  const Vector y_tied = y(tied_);
  std::vector<Vector> parts(chunk_count());
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
  for (const Block& block : blocks_) {
    if (block.delayed) continue;
    const auto ties_here = ties_of(block);
    Matrix part(ties_here.rows(), 1);
    for (std::size_t k = 0; k < block.rows.size(); ++k)
      part(static_cast<Eigen::Index>(k)) = r[at(block.rows[k])];
    part.noalias() -= ties_here * y(block.tied);
    block.inverse.solve(part);
    for (std::size_t k = 0; k < block.rows.size(); ++k)
      x[at(block.rows[k])] = part(static_cast<Eigen::Index>(k));
    sum(block.tied) += ties_here.transpose() * part;
  }
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
