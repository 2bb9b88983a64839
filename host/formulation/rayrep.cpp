#include "formulation/rayrep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "error.hpp"
#include "formulation/ray_moments.hpp"

namespace kreisel {
namespace {

enum class RayBounds { midpoint, ordered };

struct RayRepOptions {
  RayBounds bounds = RayBounds::midpoint;
  bool cell_unit = true;
};

std::vector<std::uint32_t> columns_of(const Columns& domain) {
  std::vector<std::uint32_t> columns;
  columns.reserve(domain.intervals.size());
  for (const Interval& run : domain.intervals) columns.push_back(pack_column(run.ix, run.iy));
  return columns;
}

class RayRep final : public Formulation {
 public:
  RayRep(const Columns& domain, const RayRepOptions& options, device::Device& device)
      : domain_(domain),
        options_(options),
        unit_(options.cell_unit ? domain.grid.h : 1.0),
        kernel_(device, domain.grid, columns_of(domain), unit_) {
    for (const Interval& run : domain.intervals) {
      const double low = face(run.k0), high = face(run.k1), middle = (low + high) / 2;
      const bool ordered = options.bounds == RayBounds::ordered;
      bounds_.lower.insert(bounds_.lower.end(), {low, ordered ? low : middle});
      bounds_.upper.insert(bounds_.upper.end(), {ordered ? high : middle, high});
    }
  }

  std::string_view name() const override { return "rayrep"; }
  std::size_t num_variables() const override { return 2 * domain_.intervals.size(); }
  const Bounds& bounds() const override { return bounds_; }

  SparseRows own_constraints() const override {
    SparseRows rows;
    if (options_.bounds == RayBounds::midpoint) return rows;
    const int n = static_cast<int>(domain_.intervals.size());
    for (int i = 0; i < n; ++i) {
      rows.entries.push_back({i, 2 * i, -1.0});
      rows.entries.push_back({i, 2 * i + 1, 1.0});
    }
    rows.lower.assign(domain_.intervals.size(), 0.0);
    rows.upper.assign(domain_.intervals.size(), std::numeric_limits<double>::infinity());
    return rows;
  }

  Moments moments(std::span<const double> x) override { return kernel_(x); }
  void pull_back(std::span<const double> x, std::span<const Moments> weights,
                 std::span<double> out) override {
    kernel_.pull_back(x, weights, out);
  }
  void curvature(std::span<const double> x, const Moments& weight, std::span<double> out) override {
    kernel_.curvature(x, weight, out);
  }

  Rounded round(std::span<const double> x) const override {
    Rounded rounded{VoxelSet(domain_, false)};
    const Grid& grid = domain_.grid;
    // An interior-point solver stops a little short of an active bound; there we take it to be at the bound.
    // In cells above the grid's floor.
    const auto height = [&](std::size_t j) {
      const double close = 1e-3 * grid.h / unit_;
      double z = x[j];
      if (std::abs(z - bounds_.lower[j]) < close) z = bounds_.lower[j];
      if (std::abs(z - bounds_.upper[j]) < close) z = bounds_.upper[j];
      return (z * unit_ - grid.origin[2]) / grid.h;
    };
    for (std::size_t i = 0; i < domain_.intervals.size(); ++i) {
      const Interval& run = domain_.intervals[i];
      // Halves are common, for the middle of an odd run is one. They go towards the segment's inside at both
      // ends: a void ray stays void, and a body that is point-symmetric is rounded alike on either side of
      // its axis.
      constexpr double round_off = 1e-9;
      const int from =
          std::clamp(static_cast<int>(std::floor(height(2 * i) + 0.5 + round_off)), run.k0, run.k1);
      const int to =
          std::clamp(static_cast<int>(std::ceil(height(2 * i + 1) - 0.5 - round_off)), run.k0, run.k1);
      for (int k = from; k < to; ++k)
        rounded.solid.set(rounded.solid.first(i) + static_cast<std::size_t>(k - run.k0), true);
    }
    rounded.mended = make_well_composed(rounded.solid);
    return rounded;
  }

 private:
  [[nodiscard]] double face(int k) const { return domain_.grid.face(2, k) / unit_; }

  const Columns& domain_;
  RayRepOptions options_;
  double unit_;
  RayMoments kernel_;
  Bounds bounds_;
};

}  // namespace

std::unique_ptr<Formulation> make_rayrep(const Columns& domain, const Traits&,
                                         const FormulationSettings& settings, device::Device& device) {
  RayRepOptions options;
  for (const auto& [name, value] : settings) {
    if (name == "bounds" && (value == "midpoint" || value == "ordered"))
      options.bounds = value == "ordered" ? RayBounds::ordered : RayBounds::midpoint;
    else if (name == "unit" && (value == "cell" || value == "body"))
      options.cell_unit = value == "cell";
    else
      throw InputError(
          fmt::format("formulation.{} = {} for rayrep; expected bounds = midpoint or ordered, or unit = "
                      "cell or body",
                      name, value));
  }
  return std::make_unique<RayRep>(domain, options, device);
}

}  // namespace kreisel
