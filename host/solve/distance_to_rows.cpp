#include "solve/distance_to_rows.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <vector>

#include "solve/dense.hpp"
#include "solve/dual.hpp"

namespace kreisel::core {
namespace {

using Vector = Eigen::VectorXd;

/// A point as a mixture of corners, the nearest to the origin in their hull.
class Mixture {
 public:
  explicit Mixture(const Vector& first) : corners_{first}, weights_{1.0} {}

  [[nodiscard]] Vector point() const {
    Vector sum = Vector::Zero(corners_.front().size());
    for (std::size_t i = 0; i < corners_.size(); ++i) sum += weights_[i] * corners_[i];
    return sum;
  }

  void add(const Vector& corner) {
    corners_.push_back(corner);
    weights_.push_back(0);
    while (true) {
      const Vector nearest = nearest_of_plane();
      // The part of the way there on which all weights stay positive; what becomes zero is dropped.
      double reach = 1;
      for (std::size_t i = 0; i < weights_.size(); ++i)
        if (const double to = nearest[static_cast<Eigen::Index>(i)]; to <= 0)
          reach =
              std::min(reach, weights_[i] / std::max(weights_[i] - to, std::numeric_limits<double>::min()));
      for (std::size_t i = 0; i < weights_.size(); ++i)
        weights_[i] += reach * (nearest[static_cast<Eigen::Index>(i)] - weights_[i]);
      if (reach == 1) return;
      drop_the_least();
      if (corners_.size() == 1) return;
    }
  }

 private:
  /// Weights, of sum one and any sign, of the point of the corners' affine hull that is nearest to the
  /// origin.
  [[nodiscard]] Vector nearest_of_plane() const {
    const auto n = static_cast<Eigen::Index>(corners_.size());
    Eigen::MatrixXd across(corners_.front().size(), n - 1);
    for (Eigen::Index i = 1; i < n; ++i)
      across.col(i - 1) = corners_[static_cast<std::size_t>(i)] - corners_[0];
    Vector weights(n);
    // Of least norm, for corners may depend on one another.
    weights.tail(n - 1) = shortest_solution(across, -corners_[0]);
    weights[0] = 1 - weights.tail(n - 1).sum();
    return weights;
  }

  void drop_the_least() {
    const auto least = std::ranges::min_element(weights_) - weights_.begin();
    weights_.erase(weights_.begin() + least);
    corners_.erase(corners_.begin() + least);
    double sum = 0;
    for (double& w : weights_) sum += w = std::max(w, 0.0);
    for (double& w : weights_) w /= sum;
  }

  std::vector<Vector> corners_;
  std::vector<double> weights_;
};

}  // namespace

RowDistance distance_to_rows(SupportOracle& domain, const MassModel& mass, const LinearConstraints& c,
                             double relative, double least, std::stop_token stop) {
  TotalSupport oracle(domain, mass, 0);
  // The vertex of { C s - v } that is farthest against `direction`.
  const auto vertex = [&](const Vector& direction) -> Vector {
    const Moments s = oracle(c.matrix.transpose() * direction, false).moments;
    return c.matrix * s - (direction.array() > 0).select(c.upper, c.lower);
  };
  const Moments solid = oracle(-Moments::Unit(S1), false).moments;
  Mixture mixture(c.matrix * solid - (c.lower + c.upper) / 2);
  RowDistance result;
  result.proved = -std::numeric_limits<double>::infinity();
  constexpr int most_steps = 500;
  for (int step = 0; step < most_steps && !stop.stop_requested(); ++step) {
    const Vector x = mixture.point();
    result.attained = x.norm();
    if (result.attained <= least) break;
    const Vector v = vertex(x);
    result.proved = std::max(result.proved, x.dot(v) / result.attained);
    if (result.attained - result.proved <= relative * result.attained) break;
    mixture.add(v);
  }
  return result;
}

}  // namespace kreisel::core
