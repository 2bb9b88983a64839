#include "formulation/octree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "error.hpp"
#include "formulation/leaves.hpp"
#include "settings/field_text.hpp"

namespace kreisel::core {
namespace {

class Octree final : public Formulation {
 public:
  Octree(const Columns& domain, const OctreeSettings& settings, int start_level, device::Device& device)
      : domain_(domain),
        settings_(settings),
        start_level_(start_level),
        levels_(octree_levels(domain.grid)),
        first_(first_runs(domain)),
        leaves_(domain, device) {
    restart();
  }

  std::string_view name() const override { return "octree"; }
  std::size_t num_variables() const override { return leaves_.size(); }
  const Bounds& bounds() const override { return bounds_; }
  bool moments_are_linear() const override { return true; }
  SettingTexts settings() const override {
    OctreeSettings in_force = settings_;
    in_force.start_level = start_level_;
    return SettingTable(octree_fields()).in_force(in_force);
  }

  Moments moments(std::span<const double> x) override {
    return moments_ * Eigen::Map<const Eigen::VectorXd>(x.data(), size());
  }
  void pull_back(std::span<const double>, std::span<const Moments> weights, std::span<double> out) override {
    for (std::size_t r = 0; r < weights.size(); ++r)
      Eigen::Map<Eigen::VectorXd>(out.data() + r * leaves_.size(), size()).noalias() =
          moments_.transpose() * weights[r];
  }
  void curvature(std::span<const double>, const Moments&, std::span<double> out) override {
    std::ranges::fill(out, 0.0);
  }
  const SparseForm* regulariser() const override { return weight_ > 0 ? &regulariser_ : nullptr; }

  void restart() override {
    leaves_.start(1 << (levels_ - start_level_));
    update();
  }

  bool refines() const override { return true; }
  bool refine(std::vector<double>& x) override {
    // A solve is due where more than a few of the fractional cells need not be, or where none is a voxel yet.
    // What else is coarse on the void's surface is split as it is, which changes no moment.
    constexpr std::size_t few = 100;  // one in
    const CellCounts counts = count_cells(x);
    const bool due = few * counts.coarse > counts.fractional || finest_ > 1;
    for (std::vector<std::uint8_t> split; split = to_split(x), std::ranges::find(split, 1) != split.end();) {
      const std::vector<std::uint8_t> agree = agree_with_all_around(x);
      const std::vector<std::uint8_t> count = leaves_.split(split);
      std::vector<double> fill;
      std::vector<std::uint8_t> quiet;
      for (std::size_t c = 0; c < count.size(); ++c) {
        fill.insert(fill.end(), count[c], x[c]);
        quiet.insert(quiet.end(), count[c], agree[c] && !split[c]);
      }
      x = std::move(fill);
      while (due && merge_siblings(x, quiet)) {
      }
      update();
      if (due) return true;
    }
    return false;
  }

  std::vector<Cube> cells() const override { return {leaves_.cubes().begin(), leaves_.cubes().end()}; }

  CellCounts count_cells(std::span<const double> x) const override {
    CellCounts counts;
    counts.weight = weight_;
    std::vector<std::uint8_t> along(leaves_.size());
    for (const auto& [low, high] : faces_)
      if (solid(x[low]) != solid(x[high])) along[low] = along[high] = 1;
    for (std::size_t c = 0; c < leaves_.size(); ++c) {
      const bool finest = leaves_.cubes()[c].edge == 1;
      counts.finest += finest;
      counts.along += finest && along[c];
      counts.fractional += fractional(x[c]);
      counts.coarse += fractional(x[c]) && !finest;
    }
    return counts;
  }

  Rounded round(std::span<const double> x) const override {
    Rounded rounded{VoxelSet(domain_, false)};
    const Grid& grid = domain_.grid;
    for (std::size_t c = 0; c < leaves_.size(); ++c) {
      if (!solid(x[c])) continue;
      const Cube& cube = leaves_.cubes()[c];
      for (int iy = cube.y; iy < std::min(cube.y + cube.edge, grid.n[1]); ++iy) {
        const std::size_t row = static_cast<std::size_t>(grid.n[0]) * iy;
        const auto end = static_cast<std::size_t>(std::min(cube.x + cube.edge, grid.n[0]));
        for (std::uint32_t r = first_[row + cube.x]; r < first_[row + end]; ++r) {
          const Interval& run = domain_.intervals[r];
          const int k0 = std::max<int>(run.k0, cube.z), k1 = std::min<int>(run.k1, cube.z + cube.edge);
          if (k0 < k1)
            rounded.solid.set(rounded.solid.first(r) + static_cast<std::size_t>(k0 - run.k0),
                              static_cast<std::size_t>(k1 - k0), true);
        }
      }
    }
    rounded.mended = make_well_composed(rounded.solid);
    return rounded;
  }

 private:
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(leaves_.size()); }
  [[nodiscard]] static bool solid(double fill) { return fill >= 0.5; }
  [[nodiscard]] bool fractional(double fill) const {
    return fill >= settings_.epsilon && fill <= 1 - settings_.epsilon;
  }

  /// Leaves that are not yet voxels and either fractional, or beside one that rounds to the other side: there
  /// the surface of the void would follow a coarse cell.
  [[nodiscard]] std::vector<std::uint8_t> to_split(std::span<const double> x) const {
    std::vector<std::uint8_t> split(leaves_.size());
    for (std::size_t c = 0; c < leaves_.size(); ++c) split[c] = fractional(x[c]);
    for (const auto& [low, high] : faces_)
      if (solid(x[low]) != solid(x[high])) split[low] = split[high] = 1;
    for (std::size_t c = 0; c < leaves_.size(); ++c)
      if (leaves_.cubes()[c].edge == 1) split[c] = 0;
    return split;
  }

  /// Which leaves agree with all that share a face with them, to within epsilon of the same side.
  [[nodiscard]] std::vector<std::uint8_t> agree_with_all_around(std::span<const double> x) const {
    std::vector<std::uint8_t> quiet(leaves_.size());
    for (std::size_t c = 0; c < leaves_.size(); ++c) quiet[c] = !fractional(x[c]);
    for (const auto& [low, high] : faces_)
      if (fractional(x[low]) || fractional(x[high]) || solid(x[low]) != solid(x[high]))
        quiet[low] = quiet[high] = 0;
    return quiet;
  }

  /// Makes one of all leaves in a cube where these are its children, quiet and of one side: its fill is their
  /// mean. @return  whether there were any
  bool merge_siblings(std::vector<double>& fill, std::vector<std::uint8_t>& quiet) {
    const int coarsest = 1 << (levels_ - start_level_);
    const std::vector<Leaves::Family> families =
        leaves_.siblings(coarsest, [&](std::size_t begin, std::size_t end) {
          for (std::size_t c = begin; c < end; ++c)
            if (!quiet[c] || solid(fill[c]) != solid(fill[begin])) return false;
          return true;
        });
    bool any = false;
    for (std::size_t i = 0; i < families.size(); ++i) {
      const auto& [begin, end, cube] = families[i];
      any = any || cube != leaves_.cubes()[begin];
      quiet[i] = quiet[begin];
      fill[i] = fill[begin];
      if (end - begin == 1) continue;
      double filled = 0, all = 0;
      for (std::size_t c = begin; c < end; ++c) {
        const auto voxels = static_cast<double>(leaves_.voxels(c));
        filled += fill[c] * voxels;
        all += voxels;
      }
      fill[i] = filled / all;
    }
    fill.resize(families.size());
    quiet.resize(families.size());
    if (any) leaves_.merge(families);
    return any;
  }

  /// What follows from the leaves.
  void update() {
    leaves_.moments(moments_);
    finest_ = Cube::most_edge;
    for (const Cube& cube : leaves_.cubes()) finest_ = std::min<int>(finest_, cube.edge);
    bounds_ = {std::vector<double>(leaves_.size(), 0.0), std::vector<double>(leaves_.size(), 1.0)};
    faces_ = shared_faces(leaves_.cubes(), levels_);
    // At the void's surface a cell of edge e weighs e^4 in the objective, its volume times how far it reaches
    // from the surface, where its derivative is zero. A regulariser in proportion keeps the layer of
    // fractional cells as many cells thick at every level.
    const int level = levels_ - std::countr_zero(static_cast<unsigned>(finest_));
    weight_ = settings_.gamma_l * std::pow(16.0, 3 - level);
    std::vector<int> degree(leaves_.size());
    regulariser_.entries.clear();
    for (const auto& [low, high] : faces_) {
      ++degree[low];
      ++degree[high];
      regulariser_.entries.push_back(
          {static_cast<int>(std::max(low, high)), static_cast<int>(std::min(low, high)), -weight_});
    }
    for (std::size_t c = 0; c < leaves_.size(); ++c)
      regulariser_.entries.push_back({static_cast<int>(c), static_cast<int>(c), weight_ * degree[c]});
  }

  const Columns& domain_;
  OctreeSettings settings_;
  int start_level_;
  int levels_;
  std::vector<std::uint32_t> first_;
  Leaves leaves_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> faces_;
  Eigen::Matrix<double, 10, Eigen::Dynamic> moments_;  ///< of each leaf, body units
  int finest_ = 0;                                     ///< edge of the smallest leaf
  double weight_ = 0;
  SparseForm regulariser_;
  Bounds bounds_;
};

}  // namespace

Fields<OctreeSettings> octree_fields() {
  using namespace field_text;
  return {{"gamma_l", "", "weight of the regulariser at level 3; default 1e-3",
           [](auto& s, auto k, auto v) { s.gamma_l = not_negative(k, v); },
           [](auto& s) { return number_text(s.gamma_l); }},
          {"epsilon", "", "a fill this near to 0 or 1 is none of a fraction; default 0.01",
           [](auto& s, auto k, auto v) {
             s.epsilon =
                 number_where(k, v, "a number between 0 and 0.5", [](double e) { return e > 0 && e < 0.5; });
           },
           [](auto& s) { return number_text(s.epsilon); }},
          {"start_level", "", "of the first cells; default half of the domain's levels",
           [](auto& s, auto k, auto v) { s.start_level = whole(k, v, 0); },
           [](auto& s) { return s.start_level ? std::to_string(*s.start_level) : std::string(); }}};
}

std::unique_ptr<Formulation> make_octree(const Columns& domain, const Traits&, const Settings& settings,
                                         device::Device& device) {
  const int levels = octree_levels(domain.grid);
  const int coarsest = std::max(0, levels - std::countr_zero(static_cast<unsigned>(Cube::most_edge)));
  const auto given = settings_as<OctreeSettings>(settings);
  if (const auto& level = given.start_level; level && (*level < coarsest || *level > levels))
    throw InputError(fmt::format("formulation.start_level = {}; expected {} to {}, of the domain's levels",
                                 *level, coarsest, levels));
  return std::make_unique<Octree>(domain, given, given.start_level.value_or(std::max(coarsest, levels / 2)),
                                  device);
}

}  // namespace kreisel::core
