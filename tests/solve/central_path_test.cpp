#include "solve/central_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(CentralPath, OfOneVariableIsTheRootOfItsQuadratic) {
  // barrier / x - barrier / (1 - x) = slope has a closed form.
  const Bounds bounds{{0, 0, 0, 0}, {1, 1, 1, 1}};
  const std::vector<double> slope = {-3, -1e-3, 0, 40};
  constexpr double barrier = 0.01;
  std::vector<double> x = {0, 0.3, 1, 1};
  to_central_path(x, slope, nullptr, bounds, barrier);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double s = slope[i],
                 b = s + 2 * barrier;  // s x^2 - (s + 2 barrier) x + barrier = 0, the root in (0, 1)
    const double want = s == 0 ? 0.5 : 2 * barrier / (b + std::sqrt(b * b - 4 * s * barrier));
    EXPECT_NEAR(x[i], want, 1e-6) << slope[i];
  }
}

TEST(CentralPath, MakesTheGradientOfTheBarrierProblemVanish) {
  // A chain of springs in boxes of different sizes.
  constexpr std::size_t n = 40;
  Random random(9);
  SparseForm form;
  Bounds bounds;
  std::vector<double> slope, x;
  for (std::size_t i = 0; i < n; ++i) {
    form.entries.push_back({static_cast<int>(i), static_cast<int>(i), 2.1});
    if (i > 0) form.entries.push_back({static_cast<int>(i), static_cast<int>(i) - 1, -1});
    bounds.lower.push_back(uniform(random, -1, 0));
    bounds.upper.push_back(uniform(random, 0.1, 2));
    slope.push_back(uniform(random, -2, 2));
    x.push_back(bounds.lower[i]);
  }
  constexpr double barrier = 1e-3;
  to_central_path(x, slope, &form, bounds, barrier);
  std::vector<double> gradient = slope;
  form.add_gradient(x, gradient);
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_GT(x[i], bounds.lower[i]);
    ASSERT_LT(x[i], bounds.upper[i]);
    const double low = barrier / (x[i] - bounds.lower[i]), high = barrier / (bounds.upper[i] - x[i]);
    // A sweep that moves a variable by less than a thousandth of its range was the last.
    const double curvature = 4 + low / (x[i] - bounds.lower[i]) + high / (bounds.upper[i] - x[i]);
    EXPECT_NEAR(gradient[i] - low + high, 0, 1e-2 * curvature * (bounds.upper[i] - bounds.lower[i])) << i;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
