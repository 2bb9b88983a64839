#include "experiment/simulation_table.hpp"

#include <fmt/format.h>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"
#include "physics/spin_check.hpp"

namespace kreisel::core {
namespace {

std::string strays(const SimulationSummary::Body& body) {
  return body.fell_at ? fmt::format("falls in {:.2f} s", *body.fell_at)
                      : fmt::format("{:.2f}", body.largest_tilt_degrees);
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
  const SimulationSummary& s = *run.simulation;
  std::vector<Cell> row = {model_text(run.run.asked())};
  for (const SimulationSummary::Body* body : {&s.solid, &s.part})
    for (const double rpm : {body->above->eq1, body->above->gliding, body->above->held})
      row.push_back(Cell::of(rpm, "{:.0f}"));
  if (s.contact.empty()) {
    row.insert(row.end(), 6, Cell::none());
    return row;
  }
  row.emplace_back(s.contact);
  row.push_back(Cell::of(s.rpm, "{:.0f}"));
  for (const SimulationSummary::Body* body : {&s.solid, &s.part}) {
    row.emplace_back(body->spectrum);
    row.emplace_back(strays(*body));
  }
  return row;
}

std::string simulation_note(const RecordedRun& run) {
  if (!run.simulation) return fmt::format("{}: not run\n", run_text(run.run));
  const SimulationSummary& s = *run.simulation;
  if (!s.error.empty()) return fmt::format("{}: error - {}\n", run_text(run.run), s.error);
  return s.made ? "" : fmt::format("{}: {}, no part\n", run_text(run.run), s.termination);
}

}  // namespace

Tables simulation_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&) {
  Sheet sheet = simulation_sheet();
  std::string notes;
  for (const RecordedRun& run : runs) {
    notes += simulation_note(run);
    if (run.simulation && run.simulation->part.above) sheet.add(simulation_row(run));
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
