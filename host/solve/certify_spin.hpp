// certify_spin.hpp - branch and bound on the height of the centre of mass, and for tops on sz.
#pragma once

#include <functional>

#include "solve/certificate.hpp"

namespace kreisel::core {

/// Fills in the boxes and the bound of a certificate, and what it finds that is better than `outcome`.
/// @param spent  seconds so far, which count
void certify_spin(Certificate& certificate, const Spinning& problem, const Task& task,
                  const SafeSupport& support, const Outcome& outcome, const CertifyOptions& options,
                  const std::function<double()>& spent);

/// The same for a problem that holds the centre of mass at the origin: one box, nothing to branch on, for
/// with c_z = 0 a stationary point is the minimum.
void certify_centred(Certificate& certificate, const Spinning& problem, const Task& task,
                     const SafeSupport& support, const Outcome& outcome);

}  // namespace kreisel::core
