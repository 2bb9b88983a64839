#include "formulation/quadric.hpp"

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "error.hpp"
#include "formulation/few_rays.hpp"
#include "formulation/quadric_moments.hpp"
#include "formulation/ray_moments.hpp"

namespace kreisel::core {
Rays rays_of(const Columns& domain) {
  Rays rays;
  rays.grid = domain.grid;
  for (const Interval& run : domain.intervals) {
    rays.columns.push_back(pack_column(run.ix, run.iy));
    rays.lower.push_back(domain.grid.face(2, run.k0));
    rays.upper.push_back(domain.grid.face(2, run.k1));
  }
  return rays;
}

Rays rays_of(const ExactColumns& domain) {
  Rays rays;
  rays.grid = domain.grid;
  for (const ExactInterval& run : domain.intervals) {
    rays.columns.push_back(pack_column(run.ix, run.iy));
    rays.lower.push_back(run.z0);
    rays.upper.push_back(run.z1);
  }
  return rays;
}

namespace {

/// Every second column in x and y, each for four.
Rays every_second(const Rays& fine) {
  Rays coarse;
  coarse.grid = fine.grid;
  coarse.grid.h = 2 * fine.grid.h;
  for (int axis : {0, 1}) {
    coarse.grid.n[axis] = (fine.grid.n[axis] + 1) / 2;
    coarse.grid.origin[axis] = fine.grid.centre(axis, 0) - fine.grid.h;
  }
  for (std::size_t i = 0; i < fine.columns.size(); ++i) {
    const int ix = static_cast<int>(fine.columns[i] & 0xffffu), iy = static_cast<int>(fine.columns[i] >> 16);
    if (ix % 2 != 0 || iy % 2 != 0) continue;
    coarse.columns.push_back(pack_column(ix / 2, iy / 2));
    coarse.lower.push_back(fine.lower[i]);
    coarse.upper.push_back(fine.upper[i]);
  }
  return coarse;
}

class Quadric final : public Formulation, public SupportOracle {
 public:
  /// @param voxels  to round to; may be nullptr
  Quadric(Rays rays, const Columns* voxels, device::Device& device) : voxels_(voxels) {
    const double infinity = std::numeric_limits<double>::infinity();
    bounds_ = {std::vector<double>(10, -infinity), std::vector<double>(10, infinity)};
    // Below some thousand rays a pass costs its launch, so a coarser level on the device would gain nothing.
    constexpr std::size_t least_rays = 2000, few_rays = 400;
    levels_.emplace_back(device, rays);
    while (rays.columns.size() > 4 * least_rays) {
      rays = every_second(rays);
      levels_.emplace_back(device, rays);
    }
    while (rays.columns.size() > few_rays) rays = every_second(rays);
    coarsest_.emplace(rays);
  }

  std::string_view name() const override { return "quadric"; }
  std::size_t num_variables() const override { return 10; }
  const Bounds& bounds() const override { return bounds_; }
  std::vector<double> start(Start where) const override {
    std::vector<double> q(10, 0.0);
    q[S1] = where == Start::lower ? 1 : -1;  // nothing, or all of it
    return q;
  }

  Moments moments(std::span<const double> x) override { return support(0, Moments(x.data()), false).moments; }
  void pull_back(std::span<const double> x, std::span<const Moments> weights,
                 std::span<double> out) override {
    const Matrix10 hessian = support(0, Moments(x.data()), true).hessian;
    for (std::size_t r = 0; r < weights.size(); ++r)
      Eigen::Map<Moments>(out.data() + 10 * r) = hessian * weights[r];
  }
  void curvature(std::span<const double>, const Moments&, std::span<double>) override {
    throw std::logic_error("the curvature of the moments in a quadric's coefficients is not diagonal");
  }
  void warm_up() override {
    for (int level = 0; level < levels(); ++level)
      for (const bool hessian : {false, true}) (void)support(level, -Moments::Unit(S1), hessian);
  }

  Rounded round(std::span<const double> x) const override {
    if (!voxels_) throw std::logic_error("a domain without voxels to round to");
    Rounded rounded{VoxelSet(*voxels_, false)};
    const Grid& grid = voxels_->grid;
    const Moments q(x.data());
    for (std::size_t i = 0; i < voxels_->intervals.size(); ++i) {
      const Interval& run = voxels_->intervals[i];
      const double px = grid.centre(0, run.ix), py = grid.centre(1, run.iy), hh = grid.h * grid.h / 12;
      for (int k = run.k0; k < run.k1; ++k) {
        const double pz = grid.centre(2, k);
        Moments t;
        t << 1, px, py, pz, px * py, py * pz, px * pz, px * px + hh, py * py + hh, pz * pz;
        if (q.dot(t) < 0)
          rounded.solid.set(rounded.solid.first(i) + static_cast<std::size_t>(k - run.k0), true);
      }
    }
    rounded.mended = make_well_composed(rounded.solid);
    return rounded;
  }

  SupportOracle* oracle() override { return this; }
  int levels() const override { return static_cast<int>(levels_.size()) + 1; }
  Support support(int level, const Moments& q, bool with_hessian) override {
    const auto at = static_cast<std::size_t>(level);
    return at < levels_.size() ? levels_[at](q, with_hessian) : (*coarsest_)(q, with_hessian);
  }

 private:
  const Columns* voxels_;
  Bounds bounds_;
  std::vector<QuadricMoments> levels_;  ///< on the device
  std::optional<FewRays> coarsest_;
};

}  // namespace

namespace {}  // namespace

std::unique_ptr<Formulation> make_quadric(const Columns& domain, const Traits&, const Settings&,
                                          device::Device& device) {
  return std::make_unique<Quadric>(rays_of(domain), &domain, device);
}

std::unique_ptr<Formulation> make_quadric(const Rays& rays, device::Device& device) {
  return std::make_unique<Quadric>(rays, nullptr, device);
}

}  // namespace kreisel::core
