// scale_search.hpp - the largest scale at which B still nests in A, all else given.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "nest/decide/feasibility.hpp"

namespace kreisel::core::nest {

/// What a search is told from outside.
struct SearchLimits {
  double upper = 1;         ///< no scale above this is asked for; > 0
  double abort_below = 0;   ///< give up as soon as no scale above this can nest: a particle's own best
  double tolerance = 1e-4;  ///< the answer may be smaller than the largest scale by this; > 0
};

struct FoundScale {
  double scale = 0;      ///< of a valid nesting; 0 when none was found
  bool aborted = false;  ///< whether there is none above abort_below; `scale` is 0 then
  int tests = 0;         ///< feasibility tests, or rounds of the incremental search
};

/// @throws InputError  a bound or tolerance that is not a number > 0, or a negative abort_below
void require_valid(const SearchLimits& limits);

/// One way of searching. Not to be shared by threads. The placement's own scale is not looked at.
class ScaleSearch {
 public:
  virtual ~ScaleSearch() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// @throws InputError  as require_valid(), or limits out of range
  [[nodiscard]] virtual FoundScale search(const Placement& placement, const SearchLimits& limits) = 0;
  /// Many particles at once; one limit each. The answers do not depend on the number of threads.
  [[nodiscard]] virtual std::vector<FoundScale> search(std::span<const Placement> placements,
                                                       std::span<const SearchLimits> limits);

  /// What it has learned and may answer by, within the tolerance; none as a rule. A search that recalls the
  /// memory of another answers as that one would.
  [[nodiscard]] virtual std::vector<Vec3> memory() const { return {}; }
  virtual void recall(const std::vector<Vec3>&) {}
};

/// A scale search by name: `peel`, `envelope`, `exact` by bisection, `hybrid`.
/// @param resolution  as make_feasibility()
[[nodiscard]] std::unique_ptr<ScaleSearch> make_search(std::string_view name, device::Device& device,
                                                       const Nesting& nesting, int resolution = 512);

}  // namespace kreisel::core::nest
