// error.hpp - what is thrown; what() is one line.
#pragma once

#include <stdexcept>

#include "kreisel/export.hpp"

namespace kreisel {

/// Anything that goes wrong.
struct KREISEL_API Error : std::runtime_error {
  using runtime_error::runtime_error;
};

/// What the user can mend: bad files, options, values. Says what, where, and what was expected.
struct KREISEL_API InputError : Error {
  using Error::Error;
};

/// Work was given up because its Control asked for it. Nothing is wrong, and nothing is half-written.
struct KREISEL_API Interrupted : Error {
  Interrupted() : Error("interrupted") {}
};

}  // namespace kreisel
