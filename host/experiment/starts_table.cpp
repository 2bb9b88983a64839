#include "experiment/starts_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"
#include "statistics.hpp"

namespace kreisel::core {
namespace {

struct TaskRuns {
  std::map<std::string, std::string> fields;  ///< of the configuration, but for the seed
  std::string label;
  std::vector<const RecordedRun*> runs;
};

std::vector<TaskRuns> tasks_of(const std::vector<RecordedRun>& runs) {
  std::vector<TaskRuns> tasks;
  for (const RecordedRun& run : runs) {
    auto fields = describe(run.run.run);
    fields.erase("moment.seed");
    const auto same = [&](const TaskRuns& t) { return t.label == run.run.label && t.fields == fields; };
    find_or_add(tasks, same, [&] { return TaskRuns{fields, run.run.label, {}}; }).runs.push_back(&run);
  }
  return tasks;
}

/// "12 [9, 15]": the median, and the range where there is one.
Cell spread(std::vector<double> values, int digits) {
  if (values.empty()) return Cell::none();
  std::ranges::sort(values);
  const double middle = median(values);
  const std::string range =
      values.front() == values.back()
          ? ""
          : fmt::format(" [{:.{}f}, {:.{}f}]", values.front(), digits, values.back(), digits);
  return {fmt::format("{:.{}f}{}", middle, std::fmod(2 * middle, 2) == 1 && digits == 0 ? 1 : digits, range),
          fmt::format("{}", middle)};
}

std::vector<Cell> cells_of(const TaskRuns& task) {
  std::size_t ran = 0, optimal = 0;
  double best = std::numeric_limits<double>::infinity();
  std::vector<double> iterations, evaluations, milliseconds;
  for (const RecordedRun* run : task.runs) {
    if (!has_result(*run)) continue;
    ++ran;
    if (!is_optimal(*run)) continue;
    const RecordSummary& r = *run->record;
    best = std::min(best, r.objective);
    iterations.push_back(r.iterations);
    evaluations.push_back(r.evaluations);
    milliseconds.push_back(1e3 * r.median.solve);
  }
  double violation = 0;
  std::optional<double> eigenvalue;
  std::string strict;
  for (const RecordedRun* run : task.runs) {
    if (!is_optimal(*run) || !(run->record->objective <= best + 1e-6 * std::abs(best))) continue;
    const RecordSummary& r = *run->record;
    ++optimal;
    violation = std::max(violation, r.violation);
    if (strict.empty()) strict = r.strict_minimum;
    if (r.strict_minimum != strict) strict = "not all alike";
    if (r.smallest_eigenvalue)
      eigenvalue = std::min(eigenvalue.value_or(*r.smallest_eigenvalue), *r.smallest_eigenvalue);
  }
  const auto if_any = [&](double value) { return optimal ? std::optional(value) : std::nullopt; };
  return {fmt::format("{}", ran),
          fmt::format("{}", optimal),
          Cell::of(if_any(static_cast<double>(ran) / static_cast<double>(std::max<std::size_t>(optimal, 1))),
                   "{:.2f}"),
          spread(iterations, 0),
          spread(evaluations, 0),
          spread(milliseconds, 2),
          Cell::of(if_any(best), "{:.6g}"),
          Cell::of(if_any(violation), "{:.1e}"),
          strict,
          Cell::of(eigenvalue, "{:.3g}")};
}

Cell printed(const TaskRuns& task, const std::optional<Published>& published) {
  if (!published) return Cell::none();
  const std::string model = model_text(task.runs.front()->run.asked());
  const auto at = std::ranges::find_if(published->rows, [&](const PublishedRow& row) {
    return row.seconds && row.model == model && row.label == task.label;
  });
  return at == published->rows.end() ? Cell::none() : Cell::of(at->seconds, "{:g}");
}

}  // namespace

Tables starts_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>& published) {
  Sheet sheet({{"label", "", "task", true},
               {"model", "", "model", true},
               {"grid", "", "grid", true},
               {"problem", "", ""},
               {"starts", "", "starts"},
               {"at_optimum", "", "at best"},
               {"starts_per_optimum", "", "restarts"},
               {"iterations", "median [range]", "iter"},
               {"evaluations", "median [range]", "passes"},
               {"milliseconds", "median [range]", "ms"},
               {"objective", "at best", "f"},
               {"violation", "at best", "violation"},
               {"strict_local_minimum", "at best", "strict", true},
               {"smallest_eigenvalue", "at best", "eigenvalue"},
               {"published_seconds", "paper", "s"}});
  std::string notes;
  for (const TaskRuns& task : tasks_of(runs)) {
    const RecordedRun& first = *task.runs.front();
    std::vector<Cell> cells = {task.label, model_text(first.run.asked()), grid_text(first),
                               first.run.asked().problem};
    for (Cell& cell : cells_of(task)) cells.push_back(std::move(cell));
    cells.push_back(printed(task, published));
    sheet.add(std::move(cells));
    for (const RecordedRun* run : task.runs) {
      const auto seed = run->run.asked().settings.find("moment.seed");
      notes += note_of(*run, true,
                       seed == run->run.asked().settings.end()
                           ? task.label
                           : fmt::format("{}, seed {}", task.label, seed->second));
    }
  }
  Tables tables{
      {{"", std::move(sheet), notes}},
      "at best: starts that end as optimal within 1e-6 of the lowest f of the task; restarts: starts "
      "for each of these;\n"
      "passes: over the rays, coarse ones included; strict, eigenvalue: the second-order "
      "condition, docs/quadric.md, section 3\n" +
          provenance_text(runs) + '\n'};
  if (published)
    tables.legend +=
        paper_text(published) +
        "the paper's machine, code and bodies are others, so its seconds tell nothing but the order "
        "of magnitude; an evaluation there is a mesh boolean\n";
  return tables;
}

}  // namespace kreisel::core
