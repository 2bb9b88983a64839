#include "formulation/rayrep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "formulation/ray_moments.hpp"
#include "settings/field_text.hpp"

namespace kreisel::core {
namespace {

struct RayRepOptions {
  Ends ends = Ends::both;
  RayBounds bounds = RayBounds::midpoint;  ///< where both ends vary
  bool cell_unit = true;
};

std::vector<std::uint32_t> columns_of(const Columns& domain) {
  std::vector<std::uint32_t> columns;
  columns.reserve(domain.intervals.size());
  for (const Interval& run : domain.intervals) columns.push_back(pack_column(run.ix, run.iy));
  return columns;
}

/// The end of each interval that stays where it is.
std::vector<double> fixed_ends(const Columns& domain, Ends ends, double unit) {
  std::vector<double> fixed;
  if (ends != Ends::both)
    for (const Interval& run : domain.intervals)
      fixed.push_back(domain.grid.face(2, ends == Ends::upper ? run.k0 : run.k1) / unit);
  return fixed;
}

class RayRep final : public Formulation {
 public:
  RayRep(const Columns& domain, const RayRepOptions& options, device::Device& device)
      : domain_(domain),
        options_(options),
        unit_(options.cell_unit ? domain.grid.h : 1.0),
        kernel_(device, domain.grid, columns_of(domain), unit_, options.ends,
                fixed_ends(domain, options.ends, unit_)) {
    for (const Interval& run : domain.intervals) {
      const double low = face(run.k0), high = face(run.k1), middle = (low + high) / 2;
      if (options.ends != Ends::both || options.bounds == RayBounds::ordered) {
        bounds_.lower.insert(bounds_.lower.end(), variables_a_ray(), low);
        bounds_.upper.insert(bounds_.upper.end(), variables_a_ray(), high);
      } else {
        bounds_.lower.insert(bounds_.lower.end(), {low, middle});
        bounds_.upper.insert(bounds_.upper.end(), {middle, high});
      }
    }
  }

  std::string_view name() const override { return "rayrep"; }
  std::size_t num_variables() const override { return variables_a_ray() * domain_.intervals.size(); }
  const Bounds& bounds() const override { return bounds_; }

  std::vector<double> start(Start where) const override {
    std::vector<double> x = Formulation::start(where);
    if (where == Start::middle && options_.ends == Ends::both && options_.bounds == RayBounds::ordered)
      // Half way between ordered bounds both ends meet: no material at all, where solvers see a local
      // infeasibility. The quarter points are where the midpoint bounds start, too.
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = (i % 2 == 0 ? 0.75 : 0.25) * bounds_.lower[i] + (i % 2 == 0 ? 0.25 : 0.75) * bounds_.upper[i];
    return x;
  }

  SparseRows own_constraints() const override {
    SparseRows rows;
    if (options_.ends != Ends::both || options_.bounds == RayBounds::midpoint) return rows;
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
    // Halves are common, for the middle of an odd run is one. They go towards the segment's inside at both
    // ends: a void ray stays void, and a body that is point-symmetric is rounded alike on either side of its
    // axis.
    constexpr double round_off = 1e-9;
    const auto first_solid = [&](std::size_t j) {
      return static_cast<int>(std::floor(height(j) + 0.5 + round_off));
    };
    const auto last_solid = [&](std::size_t j) {
      return static_cast<int>(std::ceil(height(j) - 0.5 - round_off));
    };
    for (std::size_t i = 0; i < domain_.intervals.size(); ++i) {
      const Interval& run = domain_.intervals[i];
      const std::size_t j = i * variables_a_ray();
      const int from = options_.ends == Ends::upper ? run.k0 : std::clamp(first_solid(j), run.k0, run.k1);
      const int to = options_.ends == Ends::lower
                         ? run.k1
                         : std::clamp(last_solid(j + variables_a_ray() - 1), run.k0, run.k1);
      for (int k = from; k < to; ++k)
        rounded.solid.set(rounded.solid.first(i) + static_cast<std::size_t>(k - run.k0), true);
    }
    rounded.mended = make_well_composed(rounded.solid);
    return rounded;
  }

 private:
  [[nodiscard]] double face(int k) const { return domain_.grid.face(2, k) / unit_; }
  [[nodiscard]] std::size_t variables_a_ray() const { return options_.ends == Ends::both ? 2 : 1; }

  const Columns& domain_;
  RayRepOptions options_;
  double unit_;
  RayMoments kernel_;
  Bounds bounds_;
};

}  // namespace

Fields<RayRepSettings> rayrep_fields() {
  using namespace field_text;
  return {one_of<RayRepSettings>(
              "bounds", "of both ends of a segment: midpoint or ordered; default as the problem fills rays",
              {"midpoint", "ordered"}, [](auto& s) -> auto& { return s.bounds; }),
          one_of<RayRepSettings>(
              "unit", "of the ends: cell (default) or body", {"body", "cell"},
              [](auto& s) -> auto& { return s.cell_unit; })};
}

std::unique_ptr<Formulation> make_rayrep(const Columns& domain, const Traits& traits,
                                         const Settings& settings, device::Device& device) {
  const auto given = settings_as<RayRepSettings>(settings);
  const RayBounds usual = traits.filling == Filling::either_end ? RayBounds::ordered : RayBounds::midpoint;
  return std::make_unique<RayRep>(
      domain,
      RayRepOptions{.ends = traits.filling == Filling::from_below ? Ends::upper : Ends::both,
                    .bounds = given.bounds.value_or(usual),
                    .cell_unit = given.cell_unit},
      device);
}

}  // namespace kreisel::core
