// fill_polygon.hpp - triangles for a plane polygon with holes.
#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "geometry/polygon.hpp"

namespace kreisel::core {

/// Cuts the region between an outer loop and the holes in it into counter-clockwise triangles that use every
/// edge of the loops, add no point, and leave none out. Ear clipping after a bridge to each hole [Eberly,
/// Triangulation by Ear Clipping, 2002], with exact signs; quadratic in the number of points. Then edges are
/// turned (flip_delaunay.hpp), so that points along a straight rim make no slivers.
///
/// @param loops  the outer one first, counter-clockwise; holes clockwise; simple, disjoint
/// @throws InputError  loops that cross each other or themselves
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> fill_polygon(std::span<const Vec2> points,
                                                                     std::vector<Loop> loops);

/// The loops that edges make. @param next  of each point that which follows it
[[nodiscard]] std::vector<Loop> loops_along(std::map<std::uint32_t, std::uint32_t> next);

/// fill_polygon() of all that counter-clockwise loops enclose, less what clockwise ones do: each of these is
/// a hole in the smallest of those around it.
/// @throws InputError  as above, and a hole in nothing
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> fill_loops(std::span<const Vec2> points,
                                                                   const std::vector<Loop>& loops);

}  // namespace kreisel::core
