#include "experiment/simulation_table.hpp"

#include <fmt/format.h>

#include <limits>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"
#include "physics/spin_check.hpp"
#include "problem/problem.hpp"

namespace kreisel {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The numbers of one body.
struct Speeds {
  double eq1 = nan, gliding = nan, held = nan;  ///< rpm; NaN: at no speed
};

Speeds speeds_of(const Problem& problem, const Moments& s, double length_mm) {
  const auto above = [&](Contact contact) {
    return stable_above(stable_rpm(s, length_mm, contact)).value_or(nan);
  };
  const auto values = problem.verify(s, length_mm).values;
  return {values.at("omega_min_rpm"), above(Contact::gliding), above(Contact::held)};
}

std::string strays(const SpinCheck& check) {
  const SpinAtSpeed& at = check.at_speed;
  return at.fell_at ? fmt::format("falls in {:.2f} s", *at.fell_at) : fmt::format("{:.2f}", at.largest_tilt);
}

std::string spectrum(const SpinCheck& check) {
  return check.at_speed.stable() ? "stable" : check.at_speed.steady ? "unstable" : "no steady spin";
}

Sheet empty_sheet() {
  std::vector<Sheet::Column> columns = {{"model", "", "model", true}};
  for (const char* body : {"solid", "part"}) {
    const std::string group = fmt::format("{}: stable above, rpm", body);
    columns.push_back({fmt::format("{}_eq1_rpm", body), group, "eq. 1"});
    columns.push_back({fmt::format("{}_gliding_rpm", body), group, "gliding"});
    columns.push_back({fmt::format("{}_held_rpm", body), group, "held"});
  }
  columns.push_back({"rpm", "", "at rpm"});
  for (const char* body : {"solid", "part"}) {
    columns.push_back({fmt::format("{}_spectrum", body), body, "spectrum", true});
    columns.push_back({fmt::format("{}_largest_tilt", body), body, "strays, deg", true});
  }
  return Sheet(std::move(columns));
}

std::vector<Cell> row_of(const RecordedRun& run) {
  const RecordSummary& r = *run.record;
  Body solid;
  solid.solid = r.solid;
  solid.frame.length = r.length_mm;
  const auto problem = make_problem(run.run.config.problem, settings_of(run.run.config, "problem"), solid);
  std::vector<Cell> row = {model_text(run.run.config)};
  SpinCheckOptions options;
  for (const Moments& s : {r.solid, r.written}) {
    const Speeds speeds = speeds_of(*problem, s, r.length_mm);
    for (const double rpm : {speeds.eq1, speeds.gliding, speeds.held}) row.push_back(Cell::of(rpm, "{:.0f}"));
    options.rpm = 1.1 * speeds.gliding;
  }
  if (options.invalid()) {
    while (row.size() < 12) row.push_back(Cell::none());
    return row;
  }
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
  Sheet sheet = empty_sheet();
  std::string notes;
  for (const RecordedRun& run : runs) {
    notes += note_of(run, false);
    if (has_result(run) && !find_problem(run.run.config.problem).upright && run.record->written[S1] > 0)
      sheet.add(row_of(run));
  }
  return {{{"", std::move(sheet), notes}},
          fmt::format("eq. 1: about the principal axis nearest to the spin axis; gliding, held: by the "
                      "spectrum, taking the "
                      "axis as principal and the centre of mass on it;\n"
                      "at rpm: 1.1 times the part's least, gliding, from a tilt of 1 degree for 10 s; no "
                      "steady spin: none "
                      "within {} degrees of the axis\n{}\n",
                      near_axis, provenance_text(runs))};
}

}  // namespace kreisel
