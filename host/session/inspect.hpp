// inspect.hpp - what is to be known of a mesh before anything is asked of it.
#pragma once

#include "body/source.hpp"
#include "control.hpp"
#include "kreisel/inspection.hpp"

namespace kreisel::core {

using kreisel::Inspection;

/// Checks, repairs, shells; as a solid its mass properties, and what it does already. On the host.
/// @param source  neither checked nor mended  @param spec  how it lies, and its density
/// @throws Interrupted
[[nodiscard]] Inspection inspect(Source source, const BodySpec& spec, const Control& control = {});

}  // namespace kreisel::core
