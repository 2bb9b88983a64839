#include "nest/search/space.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/rotation.hpp"

namespace kreisel::core::nest {
namespace {

template <int N>
using Part = Eigen::Map<Eigen::Matrix<double, N, 1>>;
template <int N>
using ConstPart = Eigen::Map<const Eigen::Matrix<double, N, 1>>;

template <int N>
void normalise(double* x) {
  Part<N> part(x);
  const double length = part.norm();
  if (length > 0 && std::isfinite(length))
    part /= length;
  else
    part = Eigen::Matrix<double, N, 1>::UnitX();
}

Eigen::Quaterniond quaternion(const double* x) { return {x[0], x[1], x[2], x[3]}; }

void store(const Eigen::Quaterniond& q, double* x) { Part<4>(x) << q.w(), q.x(), q.y(), q.z(); }

}  // namespace

Space::Space(std::vector<Block> blocks) : blocks_(std::move(blocks)) {
  for (const Block& block : blocks_) {
    size_ += block.size();
    freedom_ += block.freedom();
    steps_ += block.steps();
  }
}

void Space::project(std::span<double> x) const {
  double* at = x.data();
  for (const Block& block : blocks_) {
    if (block.kind == Block::number)
      *at = std::clamp(*at, block.lower, block.upper);
    else if (block.kind == Block::direction)
      normalise<3>(at);
    else
      normalise<4>(at);
    at += block.size();
  }
}

void Space::towards(std::span<const double> x, std::span<const double> target, std::span<double> out) const {
  std::size_t at = 0;
  for (const Block& block : blocks_) {
    const auto n = static_cast<std::size_t>(block.size());
    double sign = 1;
    if (block.kind == Block::rotation && ConstPart<4>(&x[at]).dot(ConstPart<4>(&target[at])) < 0) sign = -1;
    for (const std::size_t end = at + n; at < end; ++at) out[at] = sign * target[at] - x[at];
  }
}

void Space::place(std::span<const double> unit, std::span<double> x) const {
  const double* u = unit.data();
  double* at = x.data();
  for (const Block& block : blocks_) {
    if (block.kind == Block::number) {
      *at = block.lower + u[0] * (block.upper - block.lower);
    } else if (block.kind == Block::direction) {
      Part<3>{at} = uniform_direction(u[0], u[1]);
    } else {
      store(uniform_rotation(u[0], u[1], u[2]), at);
    }
    u += block.freedom();
    at += block.size();
  }
}

void Space::move(std::span<const double> step, std::span<double> x) const {
  const double* d = step.data();
  double* at = x.data();
  for (const Block& block : blocks_) {
    if (block.kind == Block::number) {
      *at += d[0] * (block.upper - block.lower);
    } else {
      const Eigen::Vector3d w(d[0], d[1], d[2]);
      const Eigen::Quaterniond turned(Eigen::AngleAxisd(w.norm(), w.stableNormalized()));
      if (block.kind == Block::direction) {
        Part<3> v(at);
        v = turned * Eigen::Vector3d(v);
      } else {
        store(turned * quaternion(at), at);
      }
    }
    d += block.steps();
    at += block.size();
  }
  project(x);
}

}  // namespace kreisel::core::nest
