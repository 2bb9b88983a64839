#include "experiment/maps_table.hpp"

#include <fmt/format.h>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"

namespace kreisel::core {
namespace {

Sheet maps_sheet() {
  return Sheet({{"model", "", "model", true},
                {"problem", "", "problem", true},
                {"through", "", "through", true},
                {"draft", "", "draft", true},
                {"grid", "", "grid", true},
                {"rays", "", "rays"},
                {"axes", "", "axes"},
                {"seconds", "", "seconds"},
                {"setup_seconds", "", ""},
                {"feasible_percent", "of the axes, %", "feasible"},
                {"undecided_percent", "of the axes, %", "undecided"},
                {"ok_percent", "of the axes, %", "spin, float"},
                {"best_axis", "best", "axis", true},
                {"best_objective", "best", "f"},
                {"best_omega_min_rpm", "best", "rpm"},
                {"best_metacentric_height_mm", "best", "metacentre, mm"},
                {"device", "", ""},
                {"commit", "", ""}});
}

std::vector<Cell> names_of(const RecordedRun& run, const std::string& draft) {
  const Asked& config = run.run.asked();
  const auto* map = std::get_if<MapRun>(&run.run.run);
  const bool centre = map && map->through == Through::centre;
  return {model_text(config), config.problem,
          !find_problem(config.problem).upright ? Cell(centre ? "centre" : "lowest") : Cell::none(), draft};
}

void add_case(Sheet& sheet, const RecordedRun& run, const MapSummary::Case& part, bool first) {
  const MapSummary& map = *run.map;
  std::vector<Cell> cells = names_of(run, part.draft);
  const auto once = [&](const std::string& text) { return first ? Cell(text) : Cell("", text); };
  cells.insert(cells.end(), {once(fmt::format("{}x{}x{}", map.grid[0], map.grid[1], map.grid[2])),
                             once(fmt::format("{}", map.rays)), once(fmt::format("{}", map.axes)),
                             Cell(first ? fmt::format("{:.2f}", map.sweep_seconds) : "",
                                  fmt::format("{}", map.sweep_seconds)),
                             fmt::format("{}", map.setup_seconds), Cell::of(100 * part.feasible, "{:.1f}"),
                             Cell::of(100 * part.undecided, "{:.1f}"), Cell::of(100 * part.ok, "{:.1f}")});
  if (map.best && map.best->draft == part.draft) {
    const MapSummary::Best& best = *map.best;
    cells.insert(cells.end(),
                 {Cell(fmt::format("{:.3f},{:.3f},{:.3f}", best.axis[0], best.axis[1], best.axis[2]),
                       fmt::format("{} {} {}", best.axis[0], best.axis[1], best.axis[2])),
                  Cell::of(best.objective, "{:.6g}"), Cell::of(best.values.at("omega_min_rpm"), "{:.0f}"),
                  Cell::of(best.values.at("metacentric_height_mm"), "{:.2f}")});
  } else {
    cells.insert(cells.end(), 4, Cell::none());
  }
  cells.insert(cells.end(), {map.device, map.commit});
  sheet.add(std::move(cells));
}

}  // namespace

Tables maps_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&) {
  Sheet sheet = maps_sheet();
  std::string notes;
  for (const RecordedRun& run : runs) {
    if (run.map) {
      for (const MapSummary::Case& part : run.map->cases)
        add_case(sheet, run, part, &part == &run.map->cases.front());
      continue;
    }
    std::vector<Cell> cells = names_of(run, "");
    cells.emplace_back(grid_text(run.run.asked().grid));
    cells.insert(cells.end(), 13, Cell::none());
    sheet.add(std::move(cells));
    notes += run.record ? note_of(run) : fmt::format("{}: not run\n", run_text(run.run));
  }
  return {
      {{"", std::move(sheet), notes}},
      "seconds: of the sweep over all axes, set-up excluded; spin, float: the optimum does, judged by its "
      "moments;\nbest: of least f to spin, of the highest metacentre to float; rpm: the least at which it is "
      "stable\n" +
          provenance_text(runs) + '\n'};
}

}  // namespace kreisel::core
