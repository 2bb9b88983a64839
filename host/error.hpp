// error.hpp - the one exception for what the user can mend. Programs print its line and exit with 2.
#pragma once

#include <string>

#include "kreisel/error.hpp"

namespace kreisel::core {

using kreisel::InputError;

}  // namespace kreisel::core
