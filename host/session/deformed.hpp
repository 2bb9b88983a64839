// deformed.hpp - a question about a body whose shape may change, as one about the body that it becomes.
#pragma once

#include <memory>

#include "session/deformation_report.hpp"
#include "session/session.hpp"

namespace kreisel::core {

/// A deformed body, and what of a question about the undeformed one is another thing of it.
struct Deformed {
  DeformationReport report;
  std::shared_ptr<const Source> solid;  ///< nothing: it stays as it was, for nothing was reached
  Vec3 axis = Vec3::UnitZ(), contact = Vec3::Zero();  ///< as used, model coordinates
  Wall wall;                                          ///< of the undeformed body, mm
  SettingTexts settings;  ///< of the problem: where its point is, how deep it lies

  /// The question as it is asked of the deformed body, with nothing left to deform.
  [[nodiscard]] RunConfig question(RunConfig asked) const;
};

/// Deforms the body of a question as its DeformSpec says.
/// @param stages  of the question as it stands
/// @throws InputError   what cannot be deformed, or kept
/// @throws Interrupted
[[nodiscard]] Deformed deformed(const Stages& stages, const RunConfig& question, const Control& control = {});

}  // namespace kreisel::core
