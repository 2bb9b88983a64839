#include "nest/search/climb.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "error.hpp"
#include "nest/decide/random.hpp"

namespace kreisel::core::nest {
namespace {

/// A standard normal number [Box, Muller 1958].
double normal(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  const double u = 1 - uniform(seed, a, b, 0), v = uniform(seed, a, b, 1);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

}  // namespace

std::optional<std::string> ClimbOptions::invalid() const {
  if (offspring < 1) return fmt::format("offspring = {}; expected at least one", offspring);
  if (iterations < 0) return fmt::format("iterations = {}; expected none or more", iterations);
  if (!(first_step > 0) || !(last_step > 0))
    return fmt::format("steps from {} to {}; expected numbers > 0", first_step, last_step);
  return std::nullopt;
}

Climb::Climb(Objective& objective, const ClimbOptions& options) : objective_(objective), options_(options) {
  if (const auto what = options_.invalid()) throw InputError("climb: " + *what);
}

ClimbState Climb::start(std::vector<double> x, double value) const {
  const int n = objective_.space().steps();
  ClimbState state;
  state.x = std::move(x);
  state.value = value;
  state.step = options_.first_step;
  state.success = 1 / (5 + std::sqrt(options_.offspring) / 2);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  state.covariance.assign(one.data(), one.data() + one.size());
  state.path.assign(static_cast<std::size_t>(n), 0.0);
  return state;
}

bool Climb::step(ClimbState& state) const {
  const Space& space = objective_.space();
  const int n = space.steps(), lambda = options_.offspring;
  if (state.iteration >= options_.iterations || state.step < options_.last_step || n == 0) return false;
  ++state.iteration;

  Eigen::Map<Eigen::MatrixXd> covariance(state.covariance.data(), n, n);
  Eigen::Map<Eigen::VectorXd> path(state.path.data(), n);
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  Eigen::MatrixXd steps(n, lambda);  // in units of the standard deviation
  const auto size = static_cast<std::size_t>(space.size());
  std::vector<double> positions;
  for (int i = 0; i < lambda; ++i) {
    for (int k = 0; k < n; ++k)
      steps(k, i) = normal(options_.seed, static_cast<std::uint64_t>(state.iteration),
                           static_cast<std::uint64_t>(i) * 64 + static_cast<std::uint64_t>(k));
    steps.col(i) = root * steps.col(i);
    const Eigen::VectorXd step = state.step * steps.col(i);
    positions.insert(positions.end(), state.x.begin(), state.x.end());
    const std::span<double> x(positions.data() + static_cast<std::size_t>(i) * size, size);
    space.move({step.data(), static_cast<std::size_t>(n)}, x);
    objective_.project(x);
  }
  const std::vector<double> floors(static_cast<std::size_t>(lambda), state.value);
  const std::vector<double> values = objective_.values(positions, floors);
  state.evaluations += values.size();
  const auto better = std::ranges::count_if(values, [&](double v) { return v > state.value; });

  // The step's length follows the rate of success, a fifth of the way being what suits one offspring.
  const double target = 1 / (5 + std::sqrt(lambda) / 2), rate = target * lambda / (2 + target * lambda);
  state.success = (1 - rate) * state.success + rate * static_cast<double>(better) / lambda;
  state.step *= std::exp((state.success - target) / (1 - target) / (1 + n / (2.0 * lambda)));
  state.step = std::min(state.step, 0.5);  // half a range; half a radian

  if (better > 0) {
    const auto best = std::ranges::max_element(values) - values.begin();
    const auto from = positions.begin() + best * static_cast<std::ptrdiff_t>(size);
    state.x.assign(from, from + static_cast<std::ptrdiff_t>(size));
    state.value = values[static_cast<std::size_t>(best)];
    const double fade = 2.0 / (n + 2), learn = 2.0 / (n * n + 6.0);
    const double kept = fade * (2 - fade);
    path *= 1 - fade;
    double shrink = 1 - learn;
    if (state.success < 0.44)
      path += std::sqrt(kept) * steps.col(best);
    else
      shrink += learn * kept;  // many successes: steps are too short, and their direction says little
    covariance = shrink * covariance + learn * path * path.transpose();
  }
  return true;
}

}  // namespace kreisel::core::nest
