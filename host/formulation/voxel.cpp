#include "formulation/voxel.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "formulation/voxel_moments.hpp"

namespace kreisel::core {
namespace {

std::vector<std::uint32_t> cells_of(const Columns& domain) {
  std::vector<std::uint32_t> cells;
  cells.reserve(domain.interior_voxels);
  for (const Interval& run : domain.intervals)
    for (int k = run.k0; k < run.k1; ++k) cells.push_back(pack_cell(run.ix, run.iy, k));
  return cells;
}

class Voxel final : public Formulation {
 public:
  Voxel(const Columns& domain, device::Device& device)
      : domain_(domain),
        kernel_(device, domain.grid, cells_of(domain)),
        bounds_{std::vector<double>(domain.interior_voxels, 0.0),
                std::vector<double>(domain.interior_voxels, 1.0)} {}

  std::string_view name() const override { return "voxel"; }
  std::size_t num_variables() const override { return domain_.interior_voxels; }
  const Bounds& bounds() const override { return bounds_; }
  bool moments_are_linear() const override { return true; }

  Moments moments(std::span<const double> x) override { return kernel_(x); }
  void pull_back(std::span<const double>, std::span<const Moments> weights, std::span<double> out) override {
    kernel_.pull_back(weights, out);
  }
  void curvature(std::span<const double>, const Moments&, std::span<double> out) override {
    std::ranges::fill(out, 0.0);
  }

  std::vector<Cube> cells() const override {
    std::vector<Cube> all;
    all.reserve(domain_.interior_voxels);
    for (const Interval& run : domain_.intervals)
      for (int k = run.k0; k < run.k1; ++k) all.push_back({run.ix, run.iy, static_cast<std::uint16_t>(k), 1});
    return all;
  }

  Rounded round(std::span<const double> x) const override {
    Rounded rounded{VoxelSet(domain_, false)};
    for (std::size_t v = 0; v < x.size(); ++v) rounded.solid.set(v, x[v] >= 0.5);
    rounded.mended = make_well_composed(rounded.solid);
    return rounded;
  }

 private:
  const Columns& domain_;
  VoxelMoments kernel_;
  Bounds bounds_;
};

}  // namespace

std::unique_ptr<Formulation> make_voxel(const Columns& domain, const Traits&, const Settings&,
                                        device::Device& device) {
  return std::make_unique<Voxel>(domain, device);
}

}  // namespace kreisel::core
