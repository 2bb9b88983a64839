// control.hpp - Control of kreisel/control.hpp, by the name that the host uses.
#pragma once

#include "kreisel/control.hpp"

namespace kreisel::core {

using kreisel::Control;
using kreisel::Interrupted;

}  // namespace kreisel::core
