// ways.hpp - the ways to solve a task that fills from below or from either end, and what they may be off by.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "solve/test_tasks.hpp"

namespace kreisel::core {

struct Way {
  std::string formulation, hessian;  ///< no Hessian to choose: the moment solver
  bool convexify = true;
};

inline std::string name_of(const Way& way) {
  if (way.hessian.empty()) return way.formulation;
  return way.formulation + (way.hessian != "exact" ? "_lbfgs" : way.convexify ? "_convex" : "_full");
}

inline std::ostream& operator<<(std::ostream& out, const Way& way) { return out << name_of(way); }

inline std::vector<Way> ways() {
  return {{"voxel", "exact"},         {"voxel", "limited-memory"},  {"rayrep", "exact"},
          {"rayrep", "exact", false}, {"rayrep", "limited-memory"}, {"quadric", ""}};
}

inline SolverOptions options_of(const Way& way) {
  SolverOptions options;
  options.convexify = way.convexify;
  if (!way.hessian.empty())
    options.own = solvers().find("ipopt").read({{"hessian_approximation", way.hessian}});
  return options;
}

/// What the optimum may be missed by: complementarity of every bound, what is left of the dual equations over
/// the range of every variable (8 cells at most), and Ipopt's relaxation of bounds (1e-8 of their size, up to
/// 10 cells), in an objective that changes by `size` over the whole domain.
inline double gap_of(const Task& task, const Outcome& outcome, double size) {
  const double n = static_cast<double>(task.formulation.num_variables());
  return (3 * n + 10) * outcome.complementarity + 8 * n * outcome.dual_infeasibility + 1e-7 * size;
}

}  // namespace kreisel::core
