#include "design/printed.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "error.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {
namespace {

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

double PrintedPart::beside() const {
  double sum = 0;
  for (const PrintedPiece& piece : pieces)
    sum += piece.sliced.print.volume([](const PrintGroup& group) { return !group.of_part; });
  return sum;
}

Printing::Printing(const PrintSpec& spec)
    : up_(spec.up), infill_(spec.slicing.infill.has_value()), slice_(spec.slicing) {
  if (up_ && !(up_->norm() > 0)) throw InputError("--print-up 0,0,0, expected a direction");
}

std::vector<PrintPiece> Printing::pieces(const SolvedRun& run,
                                         const std::vector<MaterialPart>& solids) const {
  return print_pieces(run.body(), solids, infill_, up_of(run.result), up_.has_value());
}

PrintedPart Printing::operator()(const SolvedRun& run, const std::vector<MaterialPart>& solids,
                                 const Control& control) const {
  const RunResult& r = run.result;
  PrintedPart part{{}, run.body().added, {}};
  double volume = 0;
  for (const PrintPiece& piece : pieces(run, solids)) {
    const Sliced& sliced =
        part.pieces
            .emplace_back(piece.name, infill_ ? slice_(piece.filled(), piece.up, piece.density, control)
                                              : slice_(piece.surface(), piece.up, piece.density, control))
            .sliced;
    part.moments += body_moments(sliced.print.part_mass(), sliced.bed_to_model, r);
    volume += sliced.print.part_volume();
  }
  part.figures = figures_of(part.moments, volume, r, run.problem().verify_at_rest(part.moments, r.length_mm));
  part.residual = residual_of(part.figures, r.config);
  return part;
}

}  // namespace kreisel::core
