// mending_fields.hpp - how a user says what may be done to a mesh.
#pragma once

#include "kreisel/mending.hpp"
#include "settings/field.hpp"

namespace kreisel::core {

using kreisel::InsideOut;
using kreisel::Mending;

[[nodiscard]] Fields<Mending> mending_fields();

}  // namespace kreisel::core
