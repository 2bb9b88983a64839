// plainer.hpp - a body of few triangles in place of one of many.
#pragma once

#include <optional>

#include "body/body.hpp"

namespace kreisel::core {

/// Within a thousandth of the body's size, for a search; nothing where the body has few triangles.
[[nodiscard]] std::optional<Body> plainer(const Body& body);

}  // namespace kreisel::core
