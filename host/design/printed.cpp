#include "design/printed.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "design/infilled.hpp"
#include "error.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {
namespace {

/// Surfaces as one mesh.
TriangleMesh joined(const std::vector<TriangleMesh>& surfaces) {
  TriangleMesh all;
  for (const TriangleMesh& surface : surfaces) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), surface.vertices.begin(), surface.vertices.end());
    for (const Triangle& t : surface.triangles)
      all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

/// From the bed to the body's frame and units. @param bed  g and mm
Moments body_moments(const Moments& bed, const Eigen::Isometry3d& bed_to_model, const RunResult& r) {
  const Frame& frame = r.frame;
  const Eigen::Isometry3d to_body =
      Eigen::Isometry3d(frame.rotation) * Eigen::Translation3d(-frame.origin) * bed_to_model;
  const double length = frame.length;
  return scaled(transformed(bed, to_body.linear(), to_body.translation()), 1 / length,
                length * length * length / r.mass_unit_grams);
}

}  // namespace

bool PrintedPart::balances() const {
  // Numbers that do not exist, because nothing of the kind was asked, are no miss.
  const auto beyond = [](double miss, double most) { return std::abs(miss) > most; };
  return figures.verdict.ok && !beyond(residual.centre_of_mass_mm, 0.01) &&
         !beyond(residual.axis_degrees, 0.02) && !beyond(residual.mass_g, 1e-3 * figures.mass);
}

Printing::Printing(const PrintSpec& spec)
    : up_(spec.up), infill_(spec.slicing.infill.has_value()), slice_(spec.slicing) {
  if (up_ && !(up_->norm() > 0)) throw InputError("--print-up 0,0,0, expected a direction");
}

PrintedPart Printing::operator()(const SolvedRun& run, const std::vector<MaterialPart>& solids,
                                 const Control& control) const {
  if (!infill_ && solids.size() != 1)
    throw InputError(
        fmt::format("--slicer of a part of {} solids, expected one: neither cut nor of several materials",
                    solids.size()));
  const RunResult& r = run.result;
  const Vec3 up = up_of(r);
  const double density = solids.front().density;
  PrintedPart part{infill_ ? slice_(filled_of(solids), up, density, control)
                           : slice_(joined(solids.front().surfaces), up, density, control),
                   {},
                   {}};
  const Print& print = part.sliced.print;
  part.moments = body_moments(print.part_mass(), part.sliced.bed_to_model, r);
  part.figures = figures_of(part.moments, print.part_volume(), r,
                            run.problem().verify_at_rest(part.moments, r.length_mm));
  part.residual = residual_of(part.figures, r.config);
  return part;
}

}  // namespace kreisel::core
