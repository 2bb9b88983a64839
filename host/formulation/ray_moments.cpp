#include "formulation/ray_moments.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "device/program.hpp"
#include "formulation/formulation.hpp"
#include "ray_moments_params.h"

namespace kreisel::core {
namespace {

/// Of every w, the polynomial that is the derivative of w . s by a z1: averaged over a column's
/// cross-section, times its area and the length of a unit.
std::vector<double> polynomials(const Grid& grid, double unit, std::span<const Moments> weights) {
  std::vector<double> all;
  for (Moments w : weights) {
    w[S1] += grid.h * grid.h / 12 * (w[SXX] + w[SYY]);
    w *= unit * grid.h * grid.h;
    all.insert(all.end(), w.begin(), w.end());
  }
  return all;
}

}  // namespace

RayMoments::RayMoments(device::Device& device, const Grid& grid, std::span<const std::uint32_t> columns,
                       double unit, Ends ends, std::span<const double> fixed)
    : device_(&device),
      grid_(grid),
      unit_(unit),
      n_(columns.size()),
      variables_(ends == Ends::both ? 2 * n_ : n_),
      columns_(device::upload_words(device, columns)),
      stride_(ends == Ends::both ? 2 * device::padded(n_) : device::padded(n_)),
      fixed_(device, ends == Ends::both ? 0 : stride_),
      x_(device, stride_),
      weights_(device, 10 * Formulation::most_weights),
      out_(device, stride_),
      rows_(device, n_) {
  if (fixed.size() != 2 * n_ - variables_)
    throw std::invalid_argument(
        fmt::format("{} fixed ends for {} rays; expected {}", fixed.size(), n_, 2 * n_ - variables_));
  if (!fixed.empty()) fixed_.upload(fixed);
  const cl::Program program =
      device::build(device, "ray_moments", fmt::format("-DENDS={}", static_cast<int>(ends)));
  sum_ = cl::Kernel(program, "ray_moments");
  sum_.setArg(1, x_.handle());
  sum_.setArg(2, columns_);
  sum_.setArg(3, fixed_.handle());
  sum_.setArg(4, rows_.handle());
  for (auto [kernel, name] :
       {std::pair{&pull_back_, "ray_pull_back"}, std::pair{&curvature_, "ray_curvature"}}) {
    *kernel = cl::Kernel(program, name);
    kernel->setArg(1, x_.handle());
    kernel->setArg(2, columns_);
    kernel->setArg(3, weights_.handle());
    kernel->setArg(4, out_.handle());
  }
}

void RayMoments::set_params(cl::Kernel& kernel, std::size_t rows) {
  device::set_params<RayParams>(*device_, kernel, 0, [&](auto& p) {
    using Real = decltype(p.h);
    p.ox = static_cast<Real>(grid_.centre(0, 0));
    p.oy = static_cast<Real>(grid_.centre(1, 0));
    p.h = static_cast<Real>(grid_.h);
    p.unit = static_cast<Real>(unit_);
    p.n = static_cast<int>(device::padded(n_));
    p.rows = static_cast<int>(rows);
    p.block = rows_.block();
  });
}

void RayMoments::require_length(std::size_t values) const {
  if (values != variables_)
    throw std::invalid_argument(fmt::format("{} values for {} rays; expected {}", values, n_, variables_));
}

Moments RayMoments::operator()(std::span<const double> x) {
  require_length(x.size());
  x_.update(x);
  set_params(sum_, 0);
  rows_.run(sum_);
  const auto joined = rows_.join();
  Moments s(joined.data());
  for (const int k : {SZ, SYZ, SXZ}) s[k] /= 2;
  s[SZZ] /= 3;
  for (const int k : {SXX, SYY}) s[k] += grid_.h * grid_.h / 12 * s[S1];
  return grid_.h * grid_.h * s;
}

void RayMoments::pull_back(std::span<const double> x, std::span<const Moments> weights,
                           std::span<double> out) {
  require_length(x.size());
  if (weights.size() > Formulation::most_weights || out.size() != weights.size() * x.size())
    throw std::invalid_argument(
        fmt::format("pull-back of {} rows into {} values for {} rays", weights.size(), out.size(), n_));
  x_.update(x);
  weights_.upload(polynomials(grid_, unit_, weights));
  if (out_.size() < weights.size() * stride_) {
    out_ = device::RealBuffer(*device_, weights.size() * stride_);
    for (cl::Kernel* kernel : {&pull_back_, &curvature_}) kernel->setArg(4, out_.handle());
  }
  set_params(pull_back_, weights.size());
  device_->run_each(pull_back_, n_);
  for (std::size_t r = 0; r < weights.size(); ++r)
    out_.download(out.subspan(r * variables_, variables_), r * stride_);
}

void RayMoments::curvature(std::span<const double> x, const Moments& weight, std::span<double> out) {
  require_length(x.size());
  require_length(out.size());
  x_.update(x);
  weights_.upload(polynomials(grid_, unit_, {&weight, 1}));
  set_params(curvature_, 1);
  device_->run_each(curvature_, n_);
  out_.download(out);
}

namespace {

/// sum_k w_k t_k averaged over a column's cross-section: a + b z + c z^2.
struct AlongRay {
  double a, b, c;
};

AlongRay along_ray(const Grid& grid, std::uint32_t column, const Moments& w) {
  const double x = grid.centre(0, static_cast<int>(column & 0xffffu));
  const double y = grid.centre(1, static_cast<int>(column >> 16)), hh = grid.h * grid.h / 12;
  return {w[S1] + w[SX] * x + w[SY] * y + w[SXY] * x * y + w[SXX] * (x * x + hh) + w[SYY] * (y * y + hh),
          w[SZ] + w[SYZ] * y + w[SXZ] * x, w[SZZ]};
}

}  // namespace

namespace reference {

MomentSums ray_moments(const Grid& grid, std::span<const std::uint32_t> columns, double unit,
                       std::span<const double> x) {
  MomentSums sum;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double cx = grid.centre(0, static_cast<int>(columns[i] & 0xffffu));
    const double cy = grid.centre(1, static_cast<int>(columns[i] >> 16));
    const double z0 = unit * x[2 * i], z1 = unit * x[2 * i + 1];
    sum.value += box_moments({cx, cy, (z0 + z1) / 2}, {grid.h, grid.h, z1 - z0});
    // Coordinates and lengths are themselves sums, so their parts enter by absolute value.
    const double reach = std::abs(z0) + std::abs(z1);
    sum.abs_sum += box_moments(
        {std::abs(cx) + 2 * std::abs(grid.origin[0]), std::abs(cy) + 2 * std::abs(grid.origin[1]), reach},
        {grid.h, grid.h, reach});
  }
  return sum;
}

void ray_pull_back(const Grid& grid, std::span<const std::uint32_t> columns, double unit,
                   std::span<const double> x, const Moments& weight, std::span<double> out) {
  const double scale = unit * grid.h * grid.h;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const AlongRay q = along_ray(grid, columns[i], weight);
    const double z0 = unit * x[2 * i], z1 = unit * x[2 * i + 1];
    out[2 * i] = -scale * (q.a + z0 * (q.b + z0 * q.c));
    out[2 * i + 1] = scale * (q.a + z1 * (q.b + z1 * q.c));
  }
}

void ray_curvature(const Grid& grid, std::span<const std::uint32_t> columns, double unit,
                   std::span<const double> x, const Moments& weight, std::span<double> out) {
  const double scale = unit * unit * grid.h * grid.h;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const AlongRay q = along_ray(grid, columns[i], weight);
    out[2 * i] = -scale * (q.b + 2 * q.c * unit * x[2 * i]);
    out[2 * i + 1] = scale * (q.b + 2 * q.c * unit * x[2 * i + 1]);
  }
}

}  // namespace reference
}  // namespace kreisel::core
