#include "solve/arrow.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace kreisel::core {
namespace {

/// More rows in the border than this are no help: the border costs the cube of their number.
constexpr std::size_t most_delayed = 256;

}  // namespace

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
  const auto border = static_cast<Eigen::Index>(own_border_.size());
  border_ = Eigen::Map<const Matrix>(store_.data() + border_at_, border, border);
  Matrix schur = border_;
  for (ArrowGroup& group : groups_) {
    negative_ += group.eliminate(store_, growth, schur);
    for (const std::size_t block : group.delayed())
      for (int i = 0; i < group.rows(); ++i) delayed_.push_back(group.row(block, i));
  }
  if (delayed_.size() > most_delayed) return false;
  extend_border(schur);
  if (!schur_.factor(schur)) return false;
  negative_ += schur_.negative();
  border_ = border_.selfadjointView<Eigen::Lower>();
  return true;
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
  for (const ArrowGroup& group : groups_)
    for (const std::size_t block : group.delayed())
      for (int i = 0; i < group.rows(); ++i, ++row) {
        for (int j = 0; j <= i; ++j) put(row, row - i + j, store_[group.own(block, i, j)]);
        for (const int place : group.tied()) put(row, place, store_[group.tie(block, i, place)]);
      }
}

/// x = D^-1 (r - F^T y) of all rows that are not in the extended border.
/// @return  F x
Arrow::Vector Arrow::behind_border(std::span<const double> r, const Vector& y, std::span<double> x) const {
  Vector sum = Vector::Zero(y.size());
  for (const ArrowGroup& group : groups_) group.behind_border(store_, r, y, x, sum);
  return sum;
}

void Arrow::solve(std::span<double> x) const {
  const std::vector<double> r(x.begin(), x.end());
  std::vector<int> border = own_border_;
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

}  // namespace kreisel::core
