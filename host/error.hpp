// error.hpp - the one exception for what the user can mend: bad files, options, values.
#pragma once

#include <stdexcept>
#include <string>

namespace kreisel {

/// Bad input. what() is one line: what, where, what was expected. Programs print it and exit with 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace kreisel
