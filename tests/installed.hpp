// installed.hpp - programs of others that tests look at results with.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace kreisel::core {

inline bool installed(const std::string& program) {
  return std::system(fmt::format("command -v '{}' > /dev/null 2>&1", program).c_str()) == 0;
}

/// Whether Debian's Python has these modules: "h5py, numpy".
inline bool imports(const std::string& modules) {
  return std::system(fmt::format("/usr/bin/python3 -c 'import {}' 2>/dev/null", modules).c_str()) == 0;
}

}  // namespace kreisel::core

/// Ends a test for which something is missing: skipped on a developer's machine, failed where KREISEL_CI is
/// set, for `setup.sh --ci` has installed all of it. A macro, because only the test itself can return.
#define KREISEL_NEEDS(there, what)                                                       \
  do {                                                                                   \
    if (there) break;                                                                    \
    if (std::getenv("KREISEL_CI")) FAIL() << (what) << " is missing, which CI installs"; \
    GTEST_SKIP() << (what) << " is not installed";                                       \
  } while (false)
