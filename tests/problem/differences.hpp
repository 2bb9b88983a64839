// differences.hpp - a problem's derivatives against central differences.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "body/test_meshes.hpp"
#include "error.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {

/// Moments as a body in body units has them: a few boxes, some of them holes, of total volume near one, well
/// above z = 0.
inline Moments random_solid(Random& random) {
  Moments s = Moments::Zero();
  for (int part = 0; part < 3; ++part)
    s += transformed(box_moments(random_vec(random, -0.2, 0.2), random_vec(random, 0.4, 0.9)),
                     random_rotation(random), Vec3(0, 0, 0.6));
  return s - box_moments({0.1, 0, 0.5}, {0.2, 0.3, 0.2});
}

/// For an f that is a quotient of linear forms of s over one of size `below`: its k-th derivative is f's size
/// times k! / below^k. With a step of cbrt(eps) below, truncation and rounding are both some eps^(2/3) /
/// below of the size; sixteen is room for sums of such terms.
struct QuotientDifferences {
  double below;
  [[nodiscard]] double step() const { return std::cbrt(0x1p-52) * below; }
  [[nodiscard]] double tolerance(double size) const { return 16 * std::pow(0x1p-52, 2.0 / 3) * size / below; }
};

inline void expect_derivatives(const Problem& problem, const Moments& s, double below) {
  const QuotientDifferences d{below};
  const Moments g = problem.gradient(s);
  const Matrix10 h = problem.hessian(s);
  const double value_size = std::abs(problem.value(s)) + 1, gradient_size = g.cwiseAbs().maxCoeff() + 1;
  for (int k = 0; k < 10; ++k) {
    const Moments up = s + d.step() * Moments::Unit(k), down = s - d.step() * Moments::Unit(k);
    const double width = up[k] - down[k];
    EXPECT_NEAR(g[k], (problem.value(up) - problem.value(down)) / width, d.tolerance(value_size))
        << moment_names[k];
    const Moments column = (problem.gradient(up) - problem.gradient(down)) / width;
    for (int i = 0; i < 10; ++i)
      EXPECT_NEAR(h(i, k), column[i], d.tolerance(gradient_size))
          << moment_names[i] << ", " << moment_names[k];
  }
  EXPECT_EQ(h, Matrix10(h.transpose()));
}

/// That make_problem() refuses `settings` in one line with `part` and "expected" in it; quotes do not matter.
inline void expect_refused(const std::string& name, const SettingTexts& settings, const Body& body,
                           std::string part) {
  std::erase(part, '\'');
  try {
    (void)make_problem(name, settings, body);
    ADD_FAILURE() << "accepted; expected: " << part;
  } catch (const InputError& e) {
    std::string text = e.what();
    std::erase(text, '\'');
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NE(text.find("expected"), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

inline void expect_text(const Verdict& verdict, const std::string& part) {
  EXPECT_NE(verdict.text.find(part), std::string::npos) << verdict.text;
}

}  // namespace kreisel::core
