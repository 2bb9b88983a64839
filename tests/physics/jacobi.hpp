// jacobi.hpp - Jacobi's elliptic functions, by the arithmetic-geometric mean. [Abramowitz, Stegun, 16.4]
#pragma once

#include <cmath>
#include <vector>

namespace kreisel::core {

struct Jacobi {
  double sn, cn, dn;
};

/// @param k  modulus, in [0, 1)
inline Jacobi jacobi(double u, double k) {
  std::vector<double> a = {1}, c = {k};
  for (double b = std::sqrt(1 - k * k); std::abs(c.back()) > 1e-16;) {
    const double next = (a.back() + b) / 2;
    c.push_back((a.back() - b) / 2);
    b = std::sqrt(a.back() * b);
    a.push_back(next);
  }
  double phi = std::ldexp(a.back() * u, static_cast<int>(a.size()) - 1);
  for (std::size_t n = a.size() - 1; n > 0; --n) phi = (phi + std::asin(c[n] / a[n] * std::sin(phi))) / 2;
  const double sn = std::sin(phi);
  return {sn, std::cos(phi), std::sqrt(1 - k * k * sn * sn)};
}

}  // namespace kreisel::core
