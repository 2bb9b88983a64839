#include "formulation/voxel_moments.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "device/program.hpp"
#include "formulation/formulation.hpp"
#include "voxel_moments_params.h"

namespace kreisel::core {
namespace {

/// Of every w, the polynomial that is the derivative of w . s by a fill: averaged over a cell, times its
/// volume.
std::vector<double> polynomials(const Grid& grid, std::span<const Moments> weights) {
  std::vector<double> all;
  for (Moments w : weights) {
    w[S1] += grid.h * grid.h / 12 * (w[SXX] + w[SYY] + w[SZZ]);
    w *= grid.h * grid.h * grid.h;
    all.insert(all.end(), w.begin(), w.end());
  }
  return all;
}

}  // namespace

VoxelMoments::VoxelMoments(device::Device& device, const Grid& grid, std::span<const std::uint32_t> cells)
    : device_(&device),
      grid_(grid),
      n_(cells.size()),
      cells_(device::upload_words(device, cells)),
      fill_(device, device::padded(n_)),
      weights_(device, 10 * Formulation::most_weights),
      out_(device, device::padded(n_)),
      rows_(device, cells.size()) {
  const cl::Program program = device::build(device, "voxel_moments");
  sum_ = cl::Kernel(program, "voxel_moments");
  sum_.setArg(1, fill_.handle());
  sum_.setArg(2, cells_);
  sum_.setArg(3, rows_.handle());
  pull_back_ = cl::Kernel(program, "voxel_pull_back");
  pull_back_.setArg(1, cells_);
  pull_back_.setArg(2, weights_.handle());
  pull_back_.setArg(3, out_.handle());
}

namespace {

template <class Params>
void fill_params(Params& p, const Grid& grid, std::size_t n, std::size_t rows, int block) {
  using Real = decltype(p.h);
  p.ox = static_cast<Real>(grid.centre(0, 0));
  p.oy = static_cast<Real>(grid.centre(1, 0));
  p.oz = static_cast<Real>(grid.centre(2, 0));
  p.h = static_cast<Real>(grid.h);
  p.n = static_cast<int>(device::padded(n));
  p.rows = static_cast<int>(rows);
  p.block = block;
}

}  // namespace

Moments VoxelMoments::operator()(std::span<const double> fill) {
  if (fill.size() != n_)
    throw std::invalid_argument(fmt::format("fill of {} values for {} voxels", fill.size(), n_));
  fill_.update(fill);
  device::set_params<VoxelParams>(*device_, sum_, 0,
                                  [&](auto& p) { fill_params(p, grid_, n_, 0, rows_.block()); });
  rows_.run(sum_);
  const auto joined = rows_.join();
  Moments s(joined.data());
  for (const int k : {SXX, SYY, SZZ}) s[k] += grid_.h * grid_.h / 12 * s[S1];
  return grid_.h * grid_.h * grid_.h * s;
}

void VoxelMoments::pull_back(std::span<const Moments> weights, std::span<double> out) {
  if (weights.size() > Formulation::most_weights || out.size() != weights.size() * n_)
    throw std::invalid_argument(
        fmt::format("pull-back of {} rows into {} values for {} voxels", weights.size(), out.size(), n_));
  weights_.upload(polynomials(grid_, weights));
  const std::size_t stride = device::padded(n_);
  if (out_.size() < weights.size() * stride) {
    out_ = device::RealBuffer(*device_, weights.size() * stride);
    pull_back_.setArg(3, out_.handle());
  }
  device::set_params<VoxelParams>(*device_, pull_back_, 0,
                                  [&](auto& p) { fill_params(p, grid_, n_, weights.size(), rows_.block()); });
  device_->run_each(pull_back_, n_);
  for (std::size_t r = 0; r < weights.size(); ++r) out_.download(out.subspan(r * n_, n_), r * stride);
}

namespace reference {

MomentSums voxel_moments(const Grid& grid, std::span<const std::uint32_t> cells,
                         std::span<const double> fill) {
  MomentSums sum;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Vec3 centre(grid.centre(0, static_cast<int>(cells[i] & 1023u)),
                      grid.centre(1, static_cast<int>(cells[i] >> 10 & 1023u)),
                      grid.centre(2, static_cast<int>(cells[i] >> 20)));
    sum.value += fill[i] * box_moments(centre, Vec3::Constant(grid.h));
    // A coordinate is itself a sum, so its parts enter by absolute value.
    const Vec3 reach = centre.cwiseAbs() + 2 * grid.origin.cwiseAbs();
    sum.abs_sum += std::abs(fill[i]) * box_moments(reach, Vec3::Constant(grid.h));
  }
  return sum;
}

void voxel_pull_back(const Grid& grid, std::span<const std::uint32_t> cells, const Moments& weight,
                     std::span<double> out) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Vec3 centre(grid.centre(0, static_cast<int>(cells[i] & 1023u)),
                      grid.centre(1, static_cast<int>(cells[i] >> 10 & 1023u)),
                      grid.centre(2, static_cast<int>(cells[i] >> 20)));
    out[i] = weight.dot(box_moments(centre, Vec3::Constant(grid.h)));
  }
}

}  // namespace reference
}  // namespace kreisel::core
