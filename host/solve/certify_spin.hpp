// certify_spin.hpp - branch and bound on the height of the centre of mass.
#pragma once

#include <functional>

#include "solve/certificate.hpp"

namespace kreisel {

/// Fills in the boxes and the bound of a certificate, and what it finds that is better than `outcome`.
/// @param spent  seconds so far, which count
void certify_spin(Certificate& certificate, const Spin& problem, const Task& task, const SafeSupport& support,
                  const Outcome& outcome, const CertifyOptions& options,
                  const std::function<double()>& spent);

}  // namespace kreisel
