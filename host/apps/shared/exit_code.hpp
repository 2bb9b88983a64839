// exit_code.hpp - how a program ended, for scripts.
#pragma once

#include "solve/solver.hpp"

namespace kreisel::core::apps {

/// 0 done, 1 slower than `bench compare` was told to allow, 2 bad input or use, 3 infeasible problem, 4
/// solver did not converge or memory ran out, 5 a part that does
/// not do what was asked, 130 interrupted.
enum ExitCode : int {
  done = 0,
  slower_than_allowed = 1,
  bad_input = 2,
  infeasible = 3,
  not_converged = 4,
  not_as_asked = 5,
  was_interrupted = 130
};

/// That of a run whose solve ended like this.
[[nodiscard]] int exit_code(Termination termination);

}  // namespace kreisel::core::apps
