#include "apps/design/print.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "print/printer/printer.hpp"
#include "problem/problem.hpp"

namespace kreisel::core::apps {
namespace {

/// Without minus signs in front of zeros.
std::string text(Vec3 v, int digits) {
  for (double& x : v)
    if (std::abs(x) < 0.5 * std::pow(10.0, -digits)) x = 0;
  return fmt::format("{:.{}f}, {:.{}f}, {:.{}f}", v[0], digits, v[1], digits, v[2], digits);
}

/// Columns: the solid, the part, and where it was sliced the print.
using Columns = std::vector<const Figures*>;

template <class Text>
void row(std::string_view name, const Columns& columns, const Text& text_of) {
  fmt::print("  {:<26}", name);
  for (const Figures* figures : columns) fmt::print(" {:>30}", text_of(*figures));
  fmt::print("\n");
}

/// A number of a verdict as people read it: its name without the unit, the unit.
struct Quantity {
  const char *name, *words;
};

/// Of all problems; what a problem does not have is not printed.
constexpr Quantity quantities[] = {
    {"omega_min_rpm", "spins above, rpm (eq. 1)"},
    {"gliding_stable_above_rpm", "stable above, rpm"},
    {"largest_over_lateral", "Izz over the next moment"},
    {"off_axis_mm", "off the axis, mm"},
    {"off_centroid_mm", "off the base's centre, mm"},
    {"inside_mm", "inside the base's edge, mm"},
    {"offset_mm", "off the vertical, mm"},
    {"tilt_degrees", "tilt, degrees"},
    {"metacentric_height_mm", "metacentric height, mm"},
    {"heel_degrees", "heels at rest, degrees"},
    {"excess_mass", "mass over displaced, share"},
    {"draft_mm", "draft, mm"},
    {"turns_degrees", "turns when hung, degrees"},
    {"least_share", "the rarest face, share"},
    {"most_share", "the commonest face, share"},
};

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.5g}", value) : "-"; }

void print_quality(const Columns& columns) {
  for (const auto& [quantity, words] : quantities) {
    const std::string name = quantity;
    const auto has = [&](const Figures* f) { return f->verdict.values.contains(name); };
    if (std::ranges::all_of(columns, has))
      row(words, columns, [&](const Figures& f) { return number(f.verdict.values.at(name)); });
  }
}

void print_table(const Design& d) {
  Columns columns = {&d.before, &d.after};
  fmt::print("  {:<26} {:>30} {:>30}{}\n", "", "solid", "part",
             d.printed ? fmt::format(" {:>30}", "print") : "");
  if (d.printed) columns.push_back(&d.printed->figures);
  row("mass, g", columns, [](const Figures& f) { return fmt::format("{:.3f}", f.mass); });
  row("volume, mm^3", columns, [](const Figures& f) { return fmt::format("{:.1f}", f.volume); });
  row("centre of mass, mm", columns, [](const Figures& f) { return text(f.centre_of_mass, 3); });
  for (int k = 0; k < 3; ++k) {
    row(fmt::format("principal moment {}, g mm^2", k + 1), columns,
        [k](const Figures& f) { return fmt::format("{:.1f}", f.principal[k]); });
    row("  about", columns, [k](const Figures& f) { return text(f.axes.col(k), 4); });
  }
  print_quality(columns);
}

std::string residual_text(const Residual& residual) {
  std::string words;
  for (const auto& [value, unit] :
       {std::pair{residual.centre_of_mass_mm, "mm (centre of mass)"},
        std::pair{residual.axis_degrees, "degrees (axis)"}, std::pair{residual.mass_g, "g"}})
    if (std::isfinite(value)) words += fmt::format("{}{:.2g} {}", words.empty() ? "" : ", ", value, unit);
  return words;
}

/// Of what a slicer makes of it.
void print_printed(const Design& d) {
  const PrintedPart& printed = *d.printed;
  const std::string& slicer = printed.first().slicer;
  fmt::print("  print      misses {}; by {}{}\n", residual_text(printed.residual),
             slicer.empty() ? "a slicer that does not say" : slicer,
             printed.pieces.size() == 1 ? "" : fmt::format(", {} pieces one by one", printed.pieces.size()));
  const double beside = printed.beside();
  if (beside > 0) fmt::print("             beside it {:.4g} mm^3 of supports and the like\n", beside);
  if (d.supports && d.supports->in_voids > 0)
    fmt::print(
        "  supports   voids would take {:.3g} cm^3 of them that nobody gets out ({:.3g} in all): --infill "
        "15% "
        "leaves no void, --cut auto opens them{}{}\n",
        1e-3 * d.supports->in_voids, 1e-3 * d.supports->in_all,
        d.drain_radius > 0 ? "" : ", --drain lets out what dissolves",
        d.found_up || printed.pieces.size() > 1 ? "" : ", --print-up auto may need less");
  if (d.found_up)
    fmt::print("  print up   {}: of {} directions {} were sliced\n", text(d.found_up->up, 3),
               d.found_up->directions, d.found_up->sliced.size());
  if (d.rounds.size() > 1)
    for (std::size_t k = 0; k < d.rounds.size(); ++k)
      fmt::print("  round {:<4} {}\n", k + 1, residual_text(d.rounds[k]));
  if (!d.print_balanced) fmt::print("             {}\n", printed.figures.verdict.text);
}

/// Whether a plane runs through the point of a peg, model coordinates.
bool cuts_point(const Plane& cut, const Stem& stem, const RunResult& r) {
  const double begin = cut.above(r.contact), along = cut.normal.dot(r.axis),
               end = begin + along * (stem.tip_height + 2 * stem.radius);
  const double across = stem.radius * std::sqrt(std::max(0.0, cut.normal.squaredNorm() - along * along));
  return begin * end <= 0 || std::min(std::abs(begin), std::abs(end)) < across;
}

void print_pieces(const Design& d) {
  if (d.pieces.empty()) return;
  constexpr std::size_t most = 6;
  std::string sizes;
  for (std::size_t k = 0; k < std::min(most, d.pieces.size()); ++k)
    sizes += fmt::format("{}{:.3g}", k > 0 ? ", " : "", 1e-3 * d.pieces[k]);
  fmt::print("  pieces     {} loose ones, to be glued: {}{} cm^3\n", d.pieces.size(), sizes,
             d.pieces.size() > most ? " and smaller" : "");
  const auto stem = stem_of(d.run.config.body.stem);
  if (stem && std::ranges::any_of(d.cuts, [&](const Plane& cut) { return cuts_point(cut, *stem, d.run); }))
    fmt::print(
        "  pieces     a cut runs through the peg's point: --cut NX,NY,NZ,D with another plane leaves it "
        "whole, and so does a print with sparse infill (--infill 15% --balance print)\n");
}

/// What a printer's and a filament's errors do to it.
void print_errors(const Design& d) {
  if (d.weighed)
    fmt::print("  weighed    {:.4g} g where {:.4g} were expected: solved again with {:.4g} g/cm^3\n",
               d.weighed->measured, d.weighed->expected, d.weighed->density);
  if (!d.survives) return;
  const auto& [least, most] = *d.survives;
  const bool no_least = !std::isfinite(least), no_most = !std::isfinite(most);
  if (no_least && no_most)
    fmt::print("  survives   any error of flow and density that printers make\n");
  else
    fmt::print("  survives   flow or density off by {} to {}\n",
               no_least ? "any less" : fmt::format("{:+.2g} %", least),
               no_most ? "any more" : fmt::format("{:+.2g} %", most));
}

void print_infill(const Design& d) {
  const InfillUse& use = *d.infill;
  const std::size_t regions = d.run.voids.pieces.size();
  fmt::print(
      "  infill     {:.4g} % {} in {} of {:.4g} mm^3: {:.1f} % of what is full, by {} test blocks of {}\n",
      use.infill.percent, use.infill.pattern, regions == 1 ? "1 region" : fmt::format("{} regions", regions),
      use.volume, 100 * use.share, use.density.blocks.size(),
      use.density.slicer.empty() ? "the slicer" : use.density.slicer);
}

void print_mould(const WrittenMould& written) {
  const Mould& m = written.mould;
  const double grams = 1e-3 * written.density;
  fmt::print("  mould      of the {}: pour {:.4g} g along {}, {:.4g} g of it are sprue and vents\n",
             written.of, grams * m.metal, text(-m.parting.normal, 3), grams * (m.metal - m.cavity));
  fmt::print(
      "             sprue of {:.2g} mm radius, {} of {:.2g} mm; the casting holds back {:.3g} mm^3{}\n",
      m.sprue_radius, m.vents == 1 ? "1 vent" : fmt::format("{} vents", m.vents), m.vent_radius,
      m.parting.undercut,
      m.parting.undercut > 1e-3 * m.casting ? ": use a mould that gives, or break it" : "");
  fmt::print("             its cavity is {:+.2g} % off the {}'s volume\n", 100 * (m.cavity / m.casting - 1),
             written.of);
  for (const auto& file : written.files) fmt::print("  written    {}\n", file.string());
}

}  // namespace

void print_design(const Design& d) {
  const RunResult& r = d.run;
  const Vec3 size = bounding_box(d.part.outer).extent();
  fmt::print("{}: {}, {:.4g} x {:.4g} x {:.4g} mm, {:.4g} g/cm^3; axis {} through {} mm\n", r.body_name,
             r.config.problem, size[0], size[1], size[2], r.density, text(r.axis, 3), text(r.contact, 2));
  for (const std::string& line : r.repairs) fmt::print("  repaired   {}\n", line);
  if (r.deformation) fmt::print("  shape      {}\n", r.deformation->text());
  if (!d.feasible()) {
    if (!d.before.verdict.text.empty()) fmt::print("  solid      {}\n", d.before.verdict.text);
    fmt::print("  infeasible {}\n", r.infeasibility);
    const bool both = !r.remedies.empty() && !d.other_axes.empty();
    if (!r.remedies.empty()) fmt::print("  would help {}\n", r.remedies);
    if (!d.other_axes.empty()) fmt::print("  {} {}\n", both ? "or        " : "would help", d.other_axes);
    const std::string& verb = find_problem(r.config.problem).verb;
    fmt::print("nothing written: no interior lets this body {} as asked\n",
               verb.empty() ? r.config.problem : verb);
    return;
  }
  if (!d.pose.empty()) fmt::print("  pose       {}\n", d.pose);
  if (const auto stem = stem_of(r.config.body.stem))
    fmt::print("  peg        of {:.3g} mm radius along the axis; it stands on its point, at {} mm\n",
               stem->radius, text(r.contact, 2));
  print_table(d);
  fmt::print("  misses     {}\n", residual_text(d.residual));
  if (d.printed) print_printed(d);
  if (std::isfinite(d.wall))
    fmt::print("  wall       {:.4f} mm at the thinnest, asked for {:.4f}\n", d.wall, r.wall * r.length_mm);
  if (d.thinnest.thickness < d.printer_accuracy)
    fmt::print("  thin       {:.4f} mm of material next to a void at {} mm, less than the printer's {:.2f}\n",
               d.thinnest.thickness, text(d.thinnest.at, 2), d.printer_accuracy);
  if (d.infill)
    print_infill(d);
  else
    fmt::print("  voids      {}\n", r.voids.text());
  print_pieces(d);
  for (const Drain& drain : d.drains)
    fmt::print("  drain      from {} mm along {}\n", text(drain.from, 2), text(drain.along, 3));
  if (d.drain_radius > 0 && d.drains.size() < r.voids.pieces.size())
    fmt::print(
        "  drain      {} of {} voids have none: no wall that is even over a hole of {:.3g} mm radius; try a "
        "smaller --drain, or --cut auto\n",
        r.voids.pieces.size() - d.drains.size(), r.voids.pieces.size(), d.drain_radius);
  print_errors(d);
  for (const auto& file : d.files) fmt::print("  written    {}\n", file.string());
  for (const WrittenMould& mould : d.moulds) print_mould(mould);
  fmt::print("  took       {:.1f} s, {:.2g} GiB; {} triangles, {} of them around voids\n", r.whole_seconds,
             r.peak_bytes / (1 << 30), r.verified.triangles, r.verified.void_triangles);
  if (!d.other_axes.empty()) fmt::print("  would help {}\n", d.other_axes);
  fmt::print("{}{}\n", d.print_balanced ? "the print " : "", d.verdict().text);
}

void print_printers() {
  fmt::print("{:<52} {:<24} {:<30} {:<12} {}\n", "printer", "bed and height", "nozzles, mm", "layers, mm",
             "by");
  for (const Printer& p : printers()) {
    const std::string layers =
        p.most_layer > 0 ? fmt::format("{:.3g}-{:.3g}", p.least_layer, p.most_layer) : "-";
    fmt::print(
        "{:<52} {:<24} {:<30} {:<12} {}\n",
        p.also.empty() || p.also.front() == p.name ? p.name : fmt::format("{} ({})", p.name, p.also.front()),
        p.size_text(), fmt::format("{}", fmt::join(p.nozzles, " ")), layers, p.source);
  }
}

}  // namespace kreisel::core::apps
