#include "apps/shared/exit_code.hpp"

namespace kreisel::core::apps {

int exit_code(Termination termination) {
  switch (termination) {
    case Termination::optimal:
    case Termination::acceptable:
      return done;
    case Termination::infeasible:
      return infeasible;
    case Termination::interrupted:
      return was_interrupted;
    case Termination::failed:
      break;
  }
  return not_converged;
}

}  // namespace kreisel::core::apps
