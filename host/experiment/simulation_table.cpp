#include "experiment/simulation_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"
#include "physics/spin_check.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// rpm; NaN: at no speed.
double above(const Moments& s, double length_mm, Contact contact) {
  return stable_above(stable_rpm(s, length_mm, contact)).value_or(nan);
}

/// With which contact and how fast: a tenth above the part's least, or half-way (as a ratio) to the solid's
/// where that is nearer; held where the part is stable gliding at no high speed. No speed: at none either.
SpinCheckOptions motion_of(const RecordSummary& r) {
  SpinCheckOptions options;
  for (const Contact contact : {Contact::gliding, Contact::held}) {
    const double part = above(r.written, r.length_mm, contact), solid = above(r.solid, r.length_mm, contact);
    if (!(part > 0)) continue;
    options.contact = contact;
    options.rpm = solid > part ? std::min(1.1 * part, std::sqrt(part * solid)) : 1.1 * part;
    break;
  }
  return options;
}

std::string strays(const SpinCheck& check) {
  const SpinAtSpeed& at = check.at_speed;
  return at.fell_at ? fmt::format("falls in {:.2f} s", *at.fell_at) : fmt::format("{:.2f}", at.largest_tilt);
}

std::string spectrum(const SpinCheck& check) {
  return check.at_speed.stable() ? "stable" : check.at_speed.steady ? "unstable" : "no steady spin";
}

Sheet simulation_sheet() {
  std::vector<Sheet::Column> columns = {{"model", "", "model", true}};
  for (const char* body : {"solid", "part"}) {
    const std::string group = fmt::format("{}: stable above, rpm", body);
    columns.push_back({fmt::format("{}_eq1_rpm", body), group, "eq. 1"});
    columns.push_back({fmt::format("{}_gliding_rpm", body), group, "gliding"});
    columns.push_back({fmt::format("{}_held_rpm", body), group, "held"});
  }
  columns.push_back({"contact", "motion", "contact", true});
  columns.push_back({"rpm", "motion", "rpm"});
  for (const char* body : {"solid", "part"}) {
    columns.push_back({fmt::format("{}_spectrum", body), body, "spectrum", true});
    columns.push_back({fmt::format("{}_largest_tilt", body), body, "strays, deg", true});
  }
  return Sheet(std::move(columns));
}

std::vector<Cell> simulation_row(const RecordedRun& run) {
  const RecordSummary& r = *run.record;
  Body solid;
  solid.solid = r.solid;
  solid.frame.length = r.length_mm;
  const auto problem = make_problem(run.run.config.problem, settings_of(run.run.config, "problem"), solid);
  std::vector<Cell> row = {model_text(run.run.config)};
  for (const Moments& s : {r.solid, r.written}) {
    row.push_back(Cell::of(problem->verify(s, r.length_mm).values.at("omega_min_rpm"), "{:.0f}"));
    for (const Contact contact : {Contact::gliding, Contact::held})
      row.push_back(Cell::of(above(s, r.length_mm, contact), "{:.0f}"));
  }
  const SpinCheckOptions options = motion_of(r);
  if (options.invalid()) {
    row.insert(row.end(), 6, Cell::none());
    return row;
  }
  row.emplace_back(std::string(name_of(options.contact)));
  row.push_back(Cell::of(options.rpm, "{:.0f}"));
  for (const Moments& s : {r.solid, r.written}) {
    const SpinCheck check = check_spin(s, r.length_mm, options);
    row.emplace_back(spectrum(check));
    row.emplace_back(strays(check));
  }
  return row;
}

}  // namespace

Tables simulation_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&) {
  Sheet sheet = simulation_sheet();
  std::string notes;
  for (const RecordedRun& run : runs) {
    notes += note_of(run, false);
    if (has_result(run) && !find_problem(run.run.config.problem).upright && run.record->written[S1] > 0)
      sheet.add(simulation_row(run));
  }
  return {
      {{"", std::move(sheet), notes}},
      fmt::format(
          "eq. 1: about the principal axis nearest to the spin axis; gliding, held: by the spectrum, taking "
          "the axis as principal and the centre of mass on it;\n"
          "motion: from a tilt of 1 degree for 10 s, at 1.1 times the part's least speed or, where nearer, "
          "half-way to the solid's;\n"
          "no steady spin: none within {} degrees of the axis\n{}\n",
          near_axis, provenance_text(runs))};
}

}  // namespace kreisel::core
