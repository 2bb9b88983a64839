// clip_ears.hpp - triangles for a plane polygon, by cutting off its ears.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace kreisel::core {

/// Cuts a polygon into triangles within it that use every edge of it and add no point [Eberly, Triangulation
/// by Ear Clipping, 2002], with exact signs. It may visit points twice, as one that goes to a hole and back
/// by the same edge does, and have corners on a straight line: those stay corners. Quadratic in the number of
/// corners as a rule, cubic at worst.
///
/// @param polygon  counter-clockwise, does not cross itself
/// @return  counter-clockwise triangles, the last without area where three corners on a line are left;
///          nothing for a polygon that crosses itself, as far as that is in the way
[[nodiscard]] std::optional<std::vector<std::array<std::uint32_t, 3>>> clip_ears(
    std::span<const Vec2> points, std::span<const std::uint32_t> polygon);

}  // namespace kreisel::core
