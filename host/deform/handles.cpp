#include "deform/handles.hpp"

#include <algorithm>
#include <cmath>

namespace kreisel::core {
namespace {

/// The four cubic B-splines that are not zero at `t` in [0, 1] of a span of unit length, and their slopes.
struct Splines {
  explicit Splines(double t) {
    const double s = 1 - t;
    value = {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
             t * t * t / 6};
    slope = {-s * s / 2, (3 * t * t - 4 * t) / 2, -(3 * s * s - 4 * s) / 2, t * t / 2};
  }
  std::array<double, 4> value, slope;
};

}  // namespace

Lattice::Lattice(const std::vector<Vec3>& points, int spans) {
  const Box box = bounding_box(points);
  span_ = box.extent().maxCoeff() / spans;
  for (int a = 0; a < 3; ++a) {
    const int along = std::max(1, static_cast<int>(std::ceil(box.extent()[a] / span_ - 1e-9)));
    n_[static_cast<std::size_t>(a)] = along + 3;
    origin_[a] = box.centre()[a] - span_ * along / 2;
  }
  index_.assign(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2], 0);  // all, until it is known which matter
  std::vector<char> used(index_.size(), 0);
  for (std::size_t s = 0; s < index_.size(); ++s) index_[s] = static_cast<std::int32_t>(s);
  constexpr double least = 1e-3;  // a handle that weighs no more anywhere only spoils the conditioning
  for (const Vec3& p : points)
    for (const HandleWeight& w : at(p)) used[w.handle] = used[w.handle] || w.weight > least;
  std::int32_t count = 0;
  for (int k = 0; k < n_[2]; ++k)
    for (int j = 0; j < n_[1]; ++j)
      for (int i = 0; i < n_[0]; ++i) {
        const std::size_t at = slot({i, j, k});
        index_[at] = used[at] ? count++ : -1;
        if (used[at]) places_.push_back({i, j, k});
      }
}

HandleWeights Lattice::at(const Vec3& x) const {
  Cell first{};
  std::array<Splines, 3> along{Splines(0), Splines(0), Splines(0)};
  for (std::size_t a = 0; a < 3; ++a) {
    const double at = (x[static_cast<Eigen::Index>(a)] - origin_[static_cast<Eigen::Index>(a)]) / span_;
    // Beyond the lattice the motion goes on as at its end.
    const int cell = std::clamp(static_cast<int>(std::floor(at)), 0, n_[a] - 4);
    first[a] = cell;
    along[a] = Splines(std::clamp(at - cell, 0.0, 1.0));
  }
  HandleWeights all;
  all.reserve(64);
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) {
        const std::int32_t handle = index_[slot({first[0] + i, first[1] + j, first[2] + k})];
        if (handle < 0) continue;
        const auto u = static_cast<std::size_t>(i), v = static_cast<std::size_t>(j),
                   w = static_cast<std::size_t>(k);
        const double bu = along[0].value[u], bv = along[1].value[v], bw = along[2].value[w];
        all.push_back(
            {static_cast<std::uint32_t>(handle), bu * bv * bw,
             Vec3(along[0].slope[u] * bv * bw, bu * along[1].slope[v] * bw, bu * bv * along[2].slope[w]) /
                 span_});
      }
  return all;
}

Eigen::MatrixXd Lattice::bending() const {
  const auto n = static_cast<Eigen::Index>(count());
  Eigen::MatrixXd energy = Eigen::MatrixXd::Zero(n, n);
  const auto handle = [&](const Cell& c) -> Eigen::Index {
    for (std::size_t a = 0; a < 3; ++a)
      if (c[a] < 0 || c[a] >= n_[a]) return -1;
    return index_[slot(c)];
  };
  const auto add = [&](std::initializer_list<std::pair<Cell, double>> difference, double weight) {
    std::vector<std::pair<Eigen::Index, double>> terms;
    for (const auto& [cell, factor] : difference) {
      const Eigen::Index at = handle(cell);
      if (at < 0) return;
      terms.emplace_back(at, factor);
    }
    for (const auto& [i, a] : terms)
      for (const auto& [j, b] : terms) energy(i, j) += weight * a * b;
  };
  const auto moved = [](Cell c, std::size_t a, int by) {
    c[a] += by;
    return c;
  };
  for (const Cell& c : places_)
    for (std::size_t a = 0; a < 3; ++a) {
      add({{moved(c, a, -1), 1}, {c, -2}, {moved(c, a, 1), 1}}, 1);
      const std::size_t b = (a + 1) % 3;  // a mixed derivative counts twice
      add({{c, 1}, {moved(c, a, 1), -1}, {moved(c, b, 1), -1}, {moved(moved(c, a, 1), b, 1), 1}}, 2);
    }
  return energy / static_cast<double>(std::max<Eigen::Index>(n, 1));
}

HandleWeights HeldHandles::at(const Vec3& x) const {
  const Freedom free = held_->at(x);
  if (free.value == 0) return {};
  HandleWeights all = inner_->at(x);
  for (HandleWeight& w : all) {
    w.gradient = free.value * w.gradient + w.weight * free.gradient;
    w.weight *= free.value;
  }
  return all;
}

}  // namespace kreisel::core
