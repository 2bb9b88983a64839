#include "domain/exact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "domain/crossings.hpp"
#include "error.hpp"
#include "parallel.hpp"

namespace kreisel::core {
namespace {

/// Where the winding number is positive.
void add_inside(LineSpans& lines, std::span<const Crossing> column) {
  int winding = 0;
  double from = 0;
  for (const Crossing& c : column) {
    const bool was_inside = winding > 0;
    winding += c.winding;
    if (!was_inside && winding > 0) from = c.z;
    if (was_inside && winding <= 0 && from < c.z) lines.spans.push_back({from, c.z});
  }
  lines.end_line();
}

LineSpans inside(const ColumnCrossings& crossings) {
  LineSpans lines;
  lines.first.reserve(crossings.size() + 1);
  for (std::size_t k = 0; k < crossings.size(); ++k) add_inside(lines, crossings[k]);
  return lines;
}

}  // namespace

SolidLines::SolidLines(const TriangleMesh& mesh, const Grid& grid) : grid_(grid) {
  const Box box = bounding_box(mesh);
  round_off_ = 64 * std::numeric_limits<double>::epsilon() *
               std::max(box.lo.cwiseAbs().maxCoeff(), box.hi.cwiseAbs().maxCoeff());
  parallel_for(2, [&](std::size_t i) {
    if (i == 0)
      pieces_.emplace(mesh);
    else
      inside_ = inside(column_crossings(mesh, grid));
  });
}

std::vector<ExactInterval> SolidLines::intervals(double wall) const {
  std::vector<ExactInterval> intervals;
  const auto add = [&](const LineSpans& lines) {
    intervals.reserve(lines.spans.size());
    for (int iy = 0; iy < grid_.n[1]; ++iy)
      for (int ix = 0; ix < grid_.n[0]; ++ix)
        for (const Span& s : lines[ix + static_cast<std::size_t>(grid_.n[0]) * iy])
          intervals.push_back({static_cast<std::uint16_t>(ix), static_cast<std::uint16_t>(iy), s.z0, s.z1});
  };
  // A flat side on the grid puts a whole layer of lines exactly as deep as the wall; they are kept (as
  // make_columns does), and round-off must not decide for each of them.
  if (wall > round_off_)
    add(pieces_->without_shell(wall - round_off_,
                               {grid_.centre(0, 0), grid_.centre(1, 0), grid_.h, grid_.n[0], grid_.n[1]},
                               inside_));
  else
    add(inside_);
  return intervals;
}

SolidLines solid_lines(const Body& body, const GridSpec& spec) {
  return {body.local, make_grid(bounding_box(body.local), spec)};
}

ExactColumns make_exact(const Body& body, const SolidLines& lines, const Wall& wall) {
  ExactColumns domain;
  domain.grid = lines.grid();
  const Grid& grid = domain.grid;
  domain.wall = in_body_units(wall, body, grid);

  domain.intervals = lines.intervals(domain.wall);
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

ExactColumns make_exact(const Body& body, const GridSpec& spec, const Wall& wall) {
  return make_exact(body, solid_lines(body, spec), wall);
}

}  // namespace kreisel::core
