// optimise.hpp - the largest copy that nests, over everything that is free. [Nest, s. 7]
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "device/device.hpp"
#include "error.hpp"
#include "nest/search/placement_search.hpp"

namespace kreisel::core::nest {

/// What to search, and how.
struct OptimiseSpec {
  Freedom freedom;
  std::vector<KeepOut> keep_outs;
  /// What the cut parts, nesting units, where A is the space inside it; null: A's surface.
  std::shared_ptr<const TriangleMesh> surface = nullptr;
  /// `basic`: the scale is one of a particle's numbers, and a test decides; `hybrid`: each particle searches
  /// its own scale; `hybrid+abort`: and gives up below its best.
  std::string variant = "hybrid+abort";
  std::string test = "hybrid";  ///< what decides: a name of make_search(), of make_feasibility() for `basic`
  int resolution = 512;         ///< of its views, where it has any
  double tolerance = 1e-4;      ///< of scales
  std::optional<double> upper;  ///< no scale above this; none: what can fit
  PlacementSearchOptions search;  ///< centroids start deep inside A, or anywhere in its box where placed so
  double seconds = std::numeric_limits<double>::infinity();  ///< after which it ends early
  /// Told of every iteration of the swarm: a position that another search found, to be taken in, or nothing.
  std::function<std::vector<double>(const SearchState& state)> guest = {};
};

/// Names of the variants. @throws InputError  (require_variant) another
[[nodiscard]] const std::vector<std::string_view>& variants();
void require_variant(std::string_view name);

struct OptimiseResult {
  std::optional<Placement> best;         ///< its scale included; nothing when nothing nests
  SearchState state;                     ///< to go on from
  bool ended_early = false;              ///< stopped, or out of time
  std::uint64_t tests = 0, aborted = 0;  ///< feasibility tests, or rounds; searches given up
  double setup_seconds = 0, search_seconds = 0;
};

/// Told after every iteration; false stops the search, which keeps its best.
using OnIteration = std::function<bool(const SearchState& state)>;

/// A state to go on from is none of this search, or is damaged.
struct UnfitState : InputError {
  using InputError::InputError;
};

/// Runs the search, from `resume` on where that is given.
/// @throws InputError  an unknown variant or test, invalid options
/// @throws UnfitState  by `resume`
[[nodiscard]] OptimiseResult optimise(const Nesting& nesting, device::Device& device,
                                      const OptimiseSpec& spec, const OnIteration& on_iteration = {},
                                      const SearchState* resume = nullptr);

/// optimise(), or another search that is asked and answers like it.
using Optimiser =
    std::function<OptimiseResult(const Nesting& nesting, device::Device& device, const OptimiseSpec& spec,
                                 const OnIteration& on_iteration, const SearchState* resume)>;

/// An objective over placements with all that it asks.
struct Asking {
  std::unique_ptr<Feasibility> feasibility;
  std::unique_ptr<ScaleSearch> search;
  std::unique_ptr<PlacementObjective> objective;
  LargestScale* largest = nullptr;  ///< the objective, where it is one
};

/// @throws InputError  an unknown test, keep-outs that hold nothing, a bound that is not > 0
[[nodiscard]] Asking make_asking(const Nesting& nesting, device::Device& device, const OptimiseSpec& spec);

/// Fills in what follows from the state: the best placement, tests and searches given up.
void finish(OptimiseResult& result, const Asking& asking);

/// Points inside A, by their distance from its surface, the deepest first: of a lattice of about `count`
/// points in its box.
[[nodiscard]] std::vector<Vec3> deep_points(const Nesting& nesting, int count);

}  // namespace kreisel::core::nest
