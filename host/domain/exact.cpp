#include "domain/exact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "domain/crossings.hpp"
#include "error.hpp"
#include "mesh/query/offset.hpp"

namespace kreisel::core {
namespace {

/// Where the winding number is positive.
std::vector<Span> inside(const std::vector<Crossing>& column) {
  std::vector<Span> spans;
  int winding = 0;
  for (const Crossing& c : column) {
    const bool was_inside = winding > 0;
    winding += c.winding;
    if (!was_inside && winding > 0) spans.push_back({c.z, c.z});
    if (was_inside && winding <= 0) {
      spans.back().z1 = c.z;
      if (!(spans.back().z0 < spans.back().z1)) spans.pop_back();
    }
  }
  return spans;
}

}  // namespace

std::vector<ExactInterval> exact_intervals(const TriangleMesh& mesh, const Grid& grid, double wall) {
  const auto crossings = column_crossings(mesh, grid);
  std::vector<std::vector<Span>> lines(crossings.size());
  std::transform(crossings.begin(), crossings.end(), lines.begin(), inside);
  // A flat side on the grid puts a whole layer of lines exactly as deep as the wall; they are kept (as
  // make_columns does), and round-off must not decide for each of them.
  const Box box = bounding_box(mesh);
  const double round_off = 64 * std::numeric_limits<double>::epsilon() *
                           std::max(box.lo.cwiseAbs().maxCoeff(), box.hi.cwiseAbs().maxCoeff());
  if (wall > round_off)
    remove_shell(mesh, wall - round_off, {grid.centre(0, 0), grid.centre(1, 0), grid.h, grid.n[0], grid.n[1]},
                 lines);
  std::vector<ExactInterval> intervals;
  for (int iy = 0; iy < grid.n[1]; ++iy)
    for (int ix = 0; ix < grid.n[0]; ++ix)
      for (const Span& s : lines[ix + static_cast<std::size_t>(grid.n[0]) * iy])
        intervals.push_back({static_cast<std::uint16_t>(ix), static_cast<std::uint16_t>(iy), s.z0, s.z1});
  return intervals;
}

ExactColumns make_exact(const Body& body, const GridSpec& spec, const Wall& wall) {
  ExactColumns domain;
  domain.grid = make_grid(bounding_box(body.local), spec);
  const Grid& grid = domain.grid;
  domain.wall = in_body_units(wall, body, grid);

  domain.intervals = exact_intervals(body.local, grid, domain.wall);
  if (domain.intervals.empty())
    throw InputError(
        fmt::format("wall {} leaves no interior in a grid of {} x {} x {}; expected a thinner wall or a "
                    "finer grid",
                    to_string(wall), grid.n[0], grid.n[1], grid.n[2]));
  for (const ExactInterval& run : domain.intervals)
    domain.interior += box_moments({grid.centre(0, run.ix), grid.centre(1, run.iy), (run.z0 + run.z1) / 2},
                                   {grid.h, grid.h, run.z1 - run.z0});
  return domain;
}

}  // namespace kreisel::core
