#include "experiment/table.hpp"

#include <fmt/format.h>

#include <map>
#include <system_error>

#include "experiment/absent_files.hpp"
#include "experiment/certificate_table.hpp"
#include "experiment/data_folder.hpp"
#include "experiment/inertia_table.hpp"
#include "experiment/linear_solver_table.hpp"
#include "experiment/maps_table.hpp"
#include "experiment/nest_table.hpp"
#include "experiment/octree_table.hpp"
#include "experiment/published_table.hpp"
#include "experiment/run_text.hpp"
#include "experiment/runner.hpp"
#include "experiment/settings_table.hpp"
#include "experiment/simulation_table.hpp"
#include "experiment/speedup_table.hpp"
#include "experiment/standing_table.hpp"
#include "experiment/starts_table.hpp"
#include "experiment/table_parts.hpp"
#include "experiment/top_table.hpp"
#include "experiment/voids_table.hpp"
#include "unknown_name.hpp"

namespace kreisel::core {

const std::vector<TableKind>& table_kinds() {
  static const std::vector<TableKind> all = {
      {"runs", "a row a run", runs_tables},
      {"speedup", "ray-reps against voxels, row by row, beside a paper", speedup_tables},
      {"published", "a row a run, beside a paper's variables and seconds", published_tables},
      {"settings", "a block a body, a row a setting: what does it gain, what does it cost", settings_tables},
      {"formulations", "a block a body, a row a formulation: what it takes and what it reaches",
       formulations_tables},
      {"linear-solvers", "a row a solve: seconds and iterations by MUMPS and by our own linear solver",
       linear_solver_tables},
      {"certificate", "a row a run: certified bound, gap, boxes, seconds", certificate_tables},
      {"maps", "a row a map of orientations and draft: how much is feasible, which axis is best", maps_tables,
       false, "map"},
      {"standing",
       "a block a body: height of the centre of mass and tilt, by target and solver, beside a paper",
       standing_tables},
      {"starts", "a row a task, over its starts: how many end at the optimum, in how many passes",
       starts_tables},
      {"voids", "a row a run: pieces of the void, islands, planar cuts, beside a paper", voids_tables},
      {"tops", "a row a run: height, moments and least speed of the solid and the part, beside a paper",
       top_tables},
      {"simulation", "a row a run: solid and part set spinning beside each other", simulation_tables, false,
       "simulation"},
      {"inertia", "a block a run: inertia tensor and principal moments before and after", inertia_tables},
      {"octree",
       "a row a run: cells, seconds and memory from the model to the written part, and what it reaches",
       octree_tables},
      {"nestings", "a row a nesting: triangles, ms a test and a search, seconds, scales, beside a paper",
       nestings_tables, true},
      {"nest-variants", "a row a setting of a search, over its seeds: scales with their spread, seconds",
       nest_variants_tables, true},
      {"nest-accuracy", "a row a resolution: sampled scales less exact ones", nest_accuracy_tables, true},
      {"nest-layers", "a row a layer: how large, how thin the wall, how long it took", nest_layers_tables,
       true},
      {"nest-landscape", "a row a map of how large outlines nest, over all rotations", nest_landscape_tables,
       true},
  };
  return all;
}

const TableKind& find_table_kind(std::string_view name) {
  for (const TableKind& kind : table_kinds())
    if (kind.name == name) return kind;
  throw unknown_name("table", name, names_of(table_kinds()));
}

std::vector<RecordedRun> collect(const Experiment& experiment, const std::filesystem::path& results) {
  std::vector<RecordedRun> runs;
  for (const ExperimentRun& run : experiment.runs) {
    const auto path = record_path(results, experiment.name, run);
    std::error_code ignored;
    RecordedRun& recorded = runs.emplace_back();
    recorded.run = run;
    if (!std::filesystem::exists(path, ignored)) continue;
    if (std::holds_alternative<NestConfig>(run.run))
      recorded.nest = read_nest(path);
    else if (std::holds_alternative<SimulationRun>(run.run))
      recorded.simulation = read_simulation(path);
    else if (std::holds_alternative<MapRun>(run.run) && is_map(path))
      recorded.map = read_map(path);
    else
      recorded.record = read_record(path);
  }
  return runs;
}

Tables tables_of(const Experiment& experiment, const std::vector<RecordedRun>& runs) {
  std::optional<Published> published;
  if (!experiment.published.empty()) published = read_published(published_file(experiment.published));
  std::vector<RecordedRun> present;
  std::map<std::string, int> absent;  // runs by what they lack
  for (const RecordedRun& run : runs) {
    const std::string lacks = run.path().empty() ? text_of_absent(run.run) : "";
    if (lacks.empty())
      present.push_back(run);
    else
      ++absent[lacks];
  }
  Tables tables = find_table_kind(experiment.table).make(present, published);
  for (const auto& [lacks, count] : absent)
    tables.legend += fmt::format("left out: {} run{}, {}\n", count, count == 1 ? "" : "s", lacks);
  return tables;
}

std::string table_text(const Experiment& experiment, const std::vector<RecordedRun>& runs) {
  return experiment.title + "\n\n" + to_text(tables_of(experiment, runs));
}

std::string table_csv(const Experiment& experiment, const std::vector<RecordedRun>& runs) {
  return to_csv(tables_of(experiment, runs));
}

Tables runs_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&) {
  std::vector<Sheet::Column> columns = {{"solver", "", "solver", true},
                                        {"variables", "", "variables"},
                                        {"iterations", "", "iterations"},
                                        {"termination", "", "termination", true},
                                        {"seconds", "", "seconds"},
                                        {"seconds_half_iqr", "", ""},
                                        {"samples", "", ""},
                                        {"objective", "", "objective"},
                                        {"violation", "", "violation"},
                                        {"verified", "", "verified", true},
                                        {"device", "", ""},
                                        {"commit", "", ""},
                                        {"error", "", ""}};
  const bool certified = any_certified(runs);
  if (certified) columns.push_back({"gap_percent", "", "gap %"});
  Sheet sheet = sheet_of_runs(std::move(columns));
  std::string errors;
  for (const RecordedRun& run : runs) {
    const SolveCells solve(run);
    std::vector<Cell> cells = opening_cells(run);
    cells.insert(cells.end(),
                 {solver_of(run.run.asked()), solve.variables, solve.iterations, termination_text(run),
                  solve.seconds, solve.half_iqr, solve.samples, solve.objective, solve.violation,
                  solve.verified, solve.device, solve.commit, run.record ? run.record->error : ""});
    if (certified) cells.push_back(gap_cell(run));
    sheet.add(std::move(cells));
    errors += note_of(run, false);
  }
  return {{{"", std::move(sheet), errors}}, provenance_text(runs) + '\n'};
}

}  // namespace kreisel::core
