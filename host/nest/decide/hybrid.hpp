// hybrid.hpp - feasibility and scale search by rays and by pairs of triangles: exact, without maps.
#pragma once

#include "mesh/query/surface_rays.hpp"
#include "nest/decide/scale_search.hpp"
#include "nest/decide/sphere_tree.hpp"
#include "nest/decide/swept_pair.hpp"

namespace kreisel::core::nest {

/// The same question as Exact, answered by descending two trees of spheres at once: two spheres whose sweep
/// stays clear of each other settle all their triangles, and the pairs that are left are decided as Exact
/// decides them.
///
/// The search starts at the upper bound and only ever goes down, each time past scales that something rules
/// out:
/// - a point of B whose way back to the cut leaves A. A ray from the gap towards the centroid tells up to
/// where the
///   same point stays in that gap: all scales on the way are invalid.
/// - a pair of triangles that meet. The scales at which they do are an interval, for the cone that T(B)'s
/// triangle
///   sweeps over all scales is convex; its lower end is next.
/// When a whole pass over both halves finds nothing, and B's shells lie inside, the scale is valid. Nothing
/// is assumed of what happens below, so feasibility need not be monotonic and 0 need not be valid.
///
/// `check` may be asked for any scale. Needs no device; batches run on all threads.
class Hybrid : public Feasibility, public ScaleSearch {
 public:
  explicit Hybrid(const Nesting& nesting);  ///< keeps a reference

  [[nodiscard]] std::string_view name() const override { return "hybrid"; }
  [[nodiscard]] Verdict check(const Placement& placement) override;
  [[nodiscard]] std::vector<Verdict> check(std::span<const Placement> placements) override;
  [[nodiscard]] FoundScale search(const Placement& placement, const SearchLimits& limits) override;
  /// Also learns: points of B that decided a search are asked first by the next batch.
  [[nodiscard]] std::vector<FoundScale> search(std::span<const Placement> placements,
                                               std::span<const SearchLimits> limits) override;
  [[nodiscard]] std::vector<Vec3> memory() const override { return witnesses_; }
  void recall(const std::vector<Vec3>& witnesses) override { witnesses_ = witnesses; }

 private:
  class Descent;
  FoundScale search_one(const Placement& placement, const SearchLimits& limits,
                        std::vector<Vec3>& deciding) const;
  void learn(const std::vector<Vec3>& deciding);

  const Nesting* nesting_;
  SphereTree outer_, inner_;
  SurfaceRays rays_;
  std::vector<std::uint32_t> shells_;
  std::vector<Vec3> witnesses_;  ///< points of B, those that decided last first
};

}  // namespace kreisel::core::nest
