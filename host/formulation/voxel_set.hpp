// voxel_set.hpp - which interior voxels of a domain are solid.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/columns.hpp"

namespace kreisel::core {

/// One flag an interior voxel, in the order of the domain's intervals and upwards within each.
/// The domain outlives the set.
class VoxelSet {
 public:
  VoxelSet(const Columns& domain, bool solid);

  [[nodiscard]] const Columns& domain() const { return *domain_; }
  [[nodiscard]] std::size_t size() const { return solid_.size(); }
  [[nodiscard]] bool solid(std::size_t voxel) const { return solid_[voxel] != 0; }
  void set(std::size_t voxel, bool solid) { solid_[voxel] = solid; }
  /// The same for `count` voxels from `voxel` on.
  void set(std::size_t voxel, std::size_t count, bool solid);
  /// Index of the lowest voxel of an interval.
  [[nodiscard]] std::size_t first(std::size_t interval) const { return first_[interval]; }
  /// The first voxel after `voxel` that differs from the one before it; `end` when none before `end` does.
  [[nodiscard]] std::size_t next_change(std::size_t voxel, std::size_t end) const;
  /// Index of an interior cell of the grid.
  [[nodiscard]] std::size_t at(int ix, int iy, int k) const;
  [[nodiscard]] std::size_t count_solid() const;

 private:
  const Columns* domain_;
  std::vector<std::size_t> first_;
  std::vector<std::uint8_t> solid_;
};

/// Ten moments of the solid voxels at unit density, body units: exact sums over boxes, on the host.
[[nodiscard]] Moments moments(const VoxelSet& set);

/// Fills void voxels until the surface between void and solid is a manifold: no two void voxels meet in an
/// edge or a corner alone, nor do two solid ones. Only fills, so it ends. [well-composed sets: Latecki 1997]
///
/// @return  how many voxels were filled
std::size_t make_well_composed(VoxelSet& set);

}  // namespace kreisel::core
