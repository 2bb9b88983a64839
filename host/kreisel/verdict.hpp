// verdict.hpp - does a finished part do what was asked?
#pragma once

#include <map>
#include <string>

namespace kreisel {

struct Verdict {
  bool ok = false;
  std::string text;                           ///< one sentence
  std::map<std::string, double> values = {};  ///< the numbers behind it; NaN where one does not exist
};

}  // namespace kreisel
