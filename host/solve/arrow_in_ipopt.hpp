// arrow_in_ipopt.hpp - Ipopt's linear systems solved by Arrow.
#pragma once

#include <IpTNLP.hpp>

#include "solve/linear_algebra.hpp"

namespace kreisel::core {

/// Whether the linear systems of a problem have the shape of an arrow, from the structure of its derivatives
/// and bounds; nothing is evaluated. @param exact  Ipopt will ask for the Hessian
[[nodiscard]] bool is_arrow(Ipopt::TNLP& nlp, bool exact);

/// While one lives, Ipopt's `linear_solver ma27` is Arrow. Ipopt takes that solver's four subroutines from
/// its user (LSL_setMA27, HSLLoader.h), for it is not free software and rarely linked; no other internals are
/// needed. One at a time in a process, made before the application is initialised.
class ArrowInIpopt {
 public:
  ArrowInIpopt();
  ~ArrowInIpopt();
  ArrowInIpopt(const ArrowInIpopt&) = delete;
  ArrowInIpopt& operator=(const ArrowInIpopt&) = delete;

 private:
  SerialBlas serial_blas_;  // Ipopt's own vectors are too short to be shared
};

}  // namespace kreisel::core
