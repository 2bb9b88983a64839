#include "apps/design/print.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "problem/problem.hpp"

namespace kreisel::core::apps {
namespace {

/// Without minus signs in front of zeros.
std::string text(Vec3 v, int digits) {
  for (double& x : v)
    if (std::abs(x) < 0.5 * std::pow(10.0, -digits)) x = 0;
  return fmt::format("{:.{}f}, {:.{}f}, {:.{}f}", v[0], digits, v[1], digits, v[2], digits);
}

void row(std::string_view name, const std::string& before, const std::string& after) {
  fmt::print("  {:<26} {:>30} {:>30}\n", name, before, after);
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

void print_quality(const Figures& before, const Figures& after) {
  for (const auto& [name, words] : quantities) {
    const auto old = before.verdict.values.find(name), now = after.verdict.values.find(name);
    if (old != before.verdict.values.end() && now != after.verdict.values.end())
      row(words, number(old->second), number(now->second));
  }
}

void print_table(const Design& d) {
  const Figures &before = d.before, &after = d.after;
  row("", "solid", "part");
  row("mass, g", fmt::format("{:.3f}", before.mass), fmt::format("{:.3f}", after.mass));
  row("volume, mm^3", fmt::format("{:.1f}", before.volume), fmt::format("{:.1f}", after.volume));
  row("centre of mass, mm", text(before.centre_of_mass, 3), text(after.centre_of_mass, 3));
  for (int k = 0; k < 3; ++k) {
    row(fmt::format("principal moment {}, g mm^2", k + 1), fmt::format("{:.1f}", before.principal[k]),
        fmt::format("{:.1f}", after.principal[k]));
    row("  about", text(before.axes.col(k), 4), text(after.axes.col(k), 4));
  }
  print_quality(before, after);
}

std::string residual_text(const Residual& residual) {
  std::string words;
  for (const auto& [value, unit] :
       {std::pair{residual.centre_of_mass_mm, "mm (centre of mass)"},
        std::pair{residual.axis_degrees, "degrees (axis)"}, std::pair{residual.mass_g, "g"}})
    if (std::isfinite(value)) words += fmt::format("{}{:.2g} {}", words.empty() ? "" : ", ", value, unit);
  return words;
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
  print_table(d);
  fmt::print("  misses     {}\n", residual_text(d.residual));
  if (std::isfinite(d.wall))
    fmt::print("  wall       {:.4f} mm at the thinnest, asked for {:.4f}\n", d.wall, r.wall * r.length_mm);
  if (d.thinnest.thickness < d.printer_accuracy)
    fmt::print("  thin       {:.4f} mm of material next to a void at {} mm, less than the printer's {:.2f}\n",
               d.thinnest.thickness, text(d.thinnest.at, 2), d.printer_accuracy);
  fmt::print("  voids      {}\n", r.voids.text());
  for (const Drain& drain : d.drains)
    fmt::print("  drain      from {} mm along {}\n", text(drain.from, 2), text(drain.along, 3));
  if (d.drain_radius > 0 && d.drains.size() < r.voids.pieces.size())
    fmt::print(
        "  drain      {} of {} voids have none: no wall that is even over a hole of {:.3g} mm radius; try a "
        "smaller --drain, or --cut auto\n",
        r.voids.pieces.size() - d.drains.size(), r.voids.pieces.size(), d.drain_radius);
  for (const auto& file : d.files) fmt::print("  written    {}\n", file.string());
  for (const WrittenMould& mould : d.moulds) print_mould(mould);
  fmt::print("  took       {:.1f} s, {:.2g} GiB; {} triangles, {} of them around voids\n", r.whole_seconds,
             r.peak_bytes / (1 << 30), r.verified.triangles, r.verified.void_triangles);
  if (!d.other_axes.empty()) fmt::print("  would help {}\n", d.other_axes);
  fmt::print("{}\n", r.verified.verdict.text);
}

}  // namespace kreisel::core::apps
