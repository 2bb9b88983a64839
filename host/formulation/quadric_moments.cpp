#include "formulation/quadric_moments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "device/program.hpp"
#include "quadric_moments_params.h"

namespace kreisel::core {
namespace {

constexpr std::size_t root_sums = 35;

/// Exponents of x, y, z in each of the ten functions.
constexpr std::array<std::array<int, 3>, 10> exponents = {{{0, 0, 0},
                                                           {1, 0, 0},
                                                           {0, 1, 0},
                                                           {0, 0, 1},
                                                           {1, 1, 0},
                                                           {0, 1, 1},
                                                           {1, 0, 1},
                                                           {2, 0, 0},
                                                           {0, 2, 0},
                                                           {0, 0, 2}}};

/// Position of x^i y^j z^k among the kernel's 35 sums.
constexpr int position(int i, int j, int k) {
  int at = 0;
  for (int below = 0; below < k; ++below) at += (5 - below) * (6 - below) / 2;
  const int degree = i + j;
  return at + degree * (degree + 1) / 2 + j;
}

/// -sum of t t^T over the roots, t averaged over the column: x^2 + h^2/12 for x^2, y^2 likewise.
Matrix10 hessian_of(const double* sums, double hh) {
  Matrix10 pure;
  for (std::size_t a = 0; a < 10; ++a)
    for (std::size_t b = 0; b < 10; ++b) {
      const auto& e = exponents[a];
      const auto& f = exponents[b];
      pure(static_cast<int>(a), static_cast<int>(b)) = -sums[position(e[0] + f[0], e[1] + f[1], e[2] + f[2])];
    }
  Matrix10 average = Matrix10::Identity();
  average(SXX, S1) = average(SYY, S1) = hh;
  return average * pure * average.transpose();
}

}  // namespace

Moments columns_of_lines(Moments s, double h) {
  s *= h * h;
  for (const int k : {SZ, SYZ, SXZ}) s[k] /= 2;
  s[SZZ] /= 3;
  for (const int k : {SXX, SYY}) s[k] += h * h / 12 * s[S1];
  return s;
}

QuadricMoments::QuadricMoments(device::Device& device, const Rays& rays)
    : device_(&device),
      grid_(rays.grid),
      n_(rays.columns.size()),
      columns_(device::upload_words(device, rays.columns)),
      lower_(device, std::max(device::padded(n_), device::padding)),
      upper_(device, std::max(device::padded(n_), device::padding)),
      plain_{device::PartialRows(device, n_), {}},
      with_hessian_{device::PartialRows(device, n_, 10 + root_sums), {}} {
  lower_.upload(rays.lower);
  upper_.upload(rays.upper);
  for (auto [pass, hessian] : {std::pair{&plain_, 0}, std::pair{&with_hessian_, 1}}) {
    const cl::Program program =
        device::build(device, "quadric_moments", fmt::format("-DHESSIAN={}", hessian));
    pass->kernel = cl::Kernel(program, "quadric_moments");
    pass->kernel.setArg(1, lower_.handle());
    pass->kernel.setArg(2, upper_.handle());
    pass->kernel.setArg(3, columns_);
    pass->kernel.setArg(4, pass->rows.handle());
  }
}

Support QuadricMoments::operator()(const Moments& q, bool with_hessian) {
  Support support;
  // The answer depends on q's direction alone; a scale of 1 keeps products of coefficients away from
  // overflow and underflow.
  const double scale = q.cwiseAbs().maxCoeff();
  if (n_ == 0 || !(scale > 0)) return support;
  const double area = grid_.h * grid_.h, hh = area / 12;
  Pass& pass = with_hessian ? with_hessian_ : plain_;
  device::set_params<QuadricParams>(*device_, pass.kernel, 0, [&](auto& p) {
    using Real = decltype(p.h);
    p.ox = static_cast<Real>(grid_.centre(0, 0));
    p.oy = static_cast<Real>(grid_.centre(1, 0));
    p.h = static_cast<Real>(grid_.h);
    for (int k = 0; k < 10; ++k) p.q[k] = static_cast<Real>(q[k] / scale);
    p.q[S1] = static_cast<Real>((q[S1] + (q[SXX] + q[SYY]) * hh) / scale);
    // A negative zero would send the root at infinity to the wrong side; some devices make one of a
    // subnormal.
    if (std::abs(p.q[SZZ]) < std::numeric_limits<Real>::min()) p.q[SZZ] = 0;
    p.inverse_a = 1 / p.q[SZZ];
    p.n = static_cast<int>(device::padded(n_));
    p.block = pass.rows.block();
  });
  pass.rows.run(pass.kernel);
  const std::vector<double> sums = pass.rows.join();
  support.moments = columns_of_lines(Moments(sums.data()), grid_.h);
  support.value = q.dot(support.moments);
  if (with_hessian) support.hessian = area / scale * hessian_of(sums.data() + 10, hh);
  return support;
}

namespace reference {
namespace {

struct Ray {
  double x, y, lower, upper;
};

Ray ray(const Rays& rays, std::size_t i) {
  return {rays.grid.centre(0, static_cast<int>(rays.columns[i] & 0xffffu)),
          rays.grid.centre(1, static_cast<int>(rays.columns[i] >> 16)), rays.lower[i], rays.upper[i]};
}

/// t averaged over the column at height z.
Moments averaged(const Ray& r, double z, double hh) {
  Moments t;
  t << 1, r.x, r.y, z, r.x * r.y, r.y * z, r.x * z, r.x * r.x + hh, r.y * r.y + hh, z * z;
  return t;
}

/// The ends of the interval and the roots between them, upwards.
std::vector<double> breaks(const Ray& r, const Moments& q, double hh) {
  const double c = q.dot(averaged(r, 0, hh)), a = q[SZZ], b = q[SZ] + q[SYZ] * r.y + q[SXZ] * r.x;
  std::vector<double> z = {r.lower, r.upper};
  const double discriminant = b * b - 4 * a * c;
  if (discriminant > 0) {
    const double t = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    for (const double root : {a == 0 ? r.lower : t / a, c / t})
      if (root > r.lower && root < r.upper) z.push_back(root);
  }
  std::ranges::sort(z);
  return z;
}

}  // namespace

MomentSums quadric_moments(const Rays& rays, const Moments& q) {
  MomentSums sum;
  const double h = rays.grid.h;
  for (std::size_t i = 0; i < rays.columns.size(); ++i) {
    const Ray r = ray(rays, i);
    const std::vector<double> z = breaks(r, q, h * h / 12);
    for (std::size_t k = 0; k + 1 < z.size(); ++k) {
      const double middle = (z[k] + z[k + 1]) / 2;
      if (!(q.dot(averaged(r, middle, h * h / 12)) < 0)) continue;
      sum.value += box_moments({r.x, r.y, middle}, {h, h, z[k + 1] - z[k]});
      const double reach = std::abs(z[k]) + std::abs(z[k + 1]);
      sum.abs_sum += box_moments({std::abs(r.x) + 2 * std::abs(rays.grid.origin[0]),
                                  std::abs(r.y) + 2 * std::abs(rays.grid.origin[1]), reach},
                                 {h, h, reach});
    }
  }
  return sum;
}

Matrix10 quadric_hessian(const Rays& rays, const Moments& q) {
  Matrix10 hessian = Matrix10::Zero();
  const double h = rays.grid.h, hh = h * h / 12;
  for (std::size_t i = 0; i < rays.columns.size(); ++i) {
    const Ray r = ray(rays, i);
    for (const double z : breaks(r, q, hh)) {
      if (!(z > r.lower && z < r.upper)) continue;
      const Moments t = averaged(r, z, hh);
      const double slope = q[SZ] + q[SYZ] * r.y + q[SXZ] * r.x + 2 * q[SZZ] * z;
      hessian -= h * h / std::abs(slope) * t * t.transpose();
    }
  }
  return hessian;
}

}  // namespace reference
}  // namespace kreisel::core
