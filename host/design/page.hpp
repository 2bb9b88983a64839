// page.hpp - a design as one HTML page that needs no network.
#pragma once

#include <string>

#include "design/design.hpp"
#include "design/nested.hpp"

namespace kreisel::core {

/// With @THREE@, @REPORT@ and @BODIES@ in place of three.js (compressed), to_json() and the meshes
/// (packed_mesh.hpp).
extern const char* const page_template;

/// A view of solid and part with a cut to move, and all numbers. [page.html]
///
/// @param three  source of three.js as a classic script, r109 or later: it knows stencils
[[nodiscard]] std::string page_of(const Design& design, const std::string& three);

/// The same of parts that come apart, with a slider that takes them.
[[nodiscard]] std::string page_of(const Nested& nested, const std::string& three);

/// three.js as Debian's libjs-three installs it. @throws InputError  it is not there
[[nodiscard]] std::string installed_three();

}  // namespace kreisel::core
