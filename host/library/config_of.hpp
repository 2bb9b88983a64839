// config_of.hpp - a public question as a run's configuration.
#pragma once

#include "kreisel/question.hpp"
#include "session/config.hpp"

namespace kreisel::core {

/// The body's mesh and the device are the session's own. @throws InputError  values that do not fit
[[nodiscard]] RunConfig config_of(const Question& question);

}  // namespace kreisel::core
