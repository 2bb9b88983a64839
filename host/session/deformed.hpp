// deformed.hpp - a question about a body whose shape may change, as one about the body that it becomes.
#pragma once

#include <memory>

#include "session/deformation_report.hpp"
#include "session/session.hpp"

namespace kreisel::core {

/// A deformed body, with the question as it is asked of it.
struct Deformed {
  DeformationReport report;
  RunConfig question;                   ///< with nothing left to deform
  std::shared_ptr<const Source> solid;  ///< nothing: it stays as it was, for nothing was reached
};

/// Deforms the body of a question as its DeformSpec says.
/// @param stages  of the question as it stands
/// @throws InputError   what cannot be deformed, or kept
/// @throws Interrupted
[[nodiscard]] Deformed deformed(const Stages& stages, const RunConfig& question, const Control& control = {});

}  // namespace kreisel::core
