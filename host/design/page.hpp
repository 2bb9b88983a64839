// page.hpp - a design as one HTML page that needs no network.
#pragma once

#include <string>

#include "design/design.hpp"

namespace kreisel {

/// With @THREE@, @REPORT@ and @MESHES@ in place of three.js, to_json() and the part's meshes.
extern const char* const page_template;

/// A view of solid and part with a cut to move, and all numbers. [page.html]
///
/// @param three  source of three.js as a classic script, r109 or later: it knows stencils
[[nodiscard]] std::string page_of(const Design& design, const std::string& three);

/// three.js as Debian's libjs-three installs it. @throws InputError  it is not there
[[nodiscard]] std::string installed_three();

}  // namespace kreisel
