// sweep.hpp - one problem in pose after pose over one domain. [docs/map.md]
#pragma once

#include <optional>

#include "session/config.hpp"
#include "session/session.hpp"
#include "solve/solver.hpp"

namespace kreisel::core {

/// The answer for one pose.
struct MapAnswer {
  enum Status { undecided, feasible, infeasible } status = undecided;
  double objective = 0;  ///< f at the optimum; NaN when not feasible
  double loss = 0;       ///< Problem::pose_loss() there; NaN when not feasible
  double miss = 0;       ///< distance of what can be attained from what is asked (distance_to_rows.hpp); 0 if
                         ///< feasible, NaN where rows are open to one side
  bool impossible = false;  ///< infeasible whatever is inside (Problem::impossible()); nothing was solved
  Verdict verdict;          ///< of the optimum's own moments, when feasible; not of a written mesh
};

/// Poses a problem by turning it: the domain is never touched again.
class Sweep {
 public:
  /// @param stages   of `config`, whose formulation is quadric; outlive the sweep, as does `control`
  Sweep(const Stages& stages, const Asked& config, const Control& control);

  /// Lays the body. Model coordinates. @param axis  any length but zero
  void turn(const Vec3& axis, const Vec3& contact);
  /// The body as it lies now.
  [[nodiscard]] const Body& body() const { return turned_; }

  /// In the pose of the last turn(). @return  nothing when the user stopped it  @throws InputError  as make()
  [[nodiscard]] std::optional<MapAnswer> answer(const Settings& settings) const;

 private:
  const Stages& stages_;
  const ProblemEntry& asked_;
  const SolverEntry& solver_;
  SolverOptions options_;
  const Control& control_;
  Body turned_;
};

/// Where an axis meets the ground: at the body's lowest point along it, or at that height below its solid's
/// centre of mass. @param axis  any length but zero
[[nodiscard]] Vec3 contact_of(const Body& body, const Vec3& axis, Through through);

}  // namespace kreisel::core
