// fill_polygon.hpp - triangles for a plane polygon with holes.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace kreisel::core {

using Point2 = std::array<double, 2>;
/// Points of a closed line, one after the other.
using Loop = std::vector<std::uint32_t>;

/// Does p lie inside the loop? Even-odd rule with exact signs; on the loop: either.
[[nodiscard]] bool inside_loop(std::span<const Point2> points, std::span<const std::uint32_t> loop,
                               const Point2& p);

/// Twice the area, positive when the loop runs counter-clockwise.
[[nodiscard]] double twice_area(std::span<const Point2> points, std::span<const std::uint32_t> loop);

/// Cuts the region between an outer loop and the holes in it into counter-clockwise triangles that use every
/// edge of the loops, add no point, and leave none out. Ear clipping after a bridge to each hole [Eberly,
/// Triangulation by Ear Clipping, 2002], with exact signs; quadratic in the number of points. Then edges are
/// turned (flip_delaunay.hpp), so that points along a straight rim make no slivers.
///
/// @param loops  the outer one first, counter-clockwise; holes clockwise; simple, disjoint
/// @throws InputError  loops that cross each other or themselves
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> fill_polygon(
    std::span<const Point2> points, std::vector<std::vector<std::uint32_t>> loops);

/// The loops that edges make. @param next  of each point that which follows it
[[nodiscard]] std::vector<Loop> loops_along(std::map<std::uint32_t, std::uint32_t> next);

/// fill_polygon() of all that counter-clockwise loops enclose, less what clockwise ones do: each of these is
/// a hole in the smallest of those around it.
/// @throws InputError  as above, and a hole in nothing
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> fill_loops(std::span<const Point2> points,
                                                                   const std::vector<Loop>& loops);

}  // namespace kreisel::core
