#include "table/starts_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "statistics.hpp"
#include "table/table_parts.hpp"

namespace kreisel::core {
namespace {

struct TaskRuns {
  std::string label;
  std::vector<const RecordedRun*> runs;
};

std::vector<TaskRuns> tasks_of(const std::vector<RecordedRun>& runs) {
  std::vector<TaskRuns> tasks;
  std::map<std::pair<std::string, std::map<std::string, std::string>>, std::size_t> known;
  for (const RecordedRun& run : runs) {
    auto fields = fields_of(run.run);  // of the configuration, but for the seed
    fields.erase("moment.seed");
    const auto [at, is_new] = known.try_emplace({run.run.label, std::move(fields)}, tasks.size());
    if (is_new) tasks.push_back({run.run.label, {}});
    tasks[at->second].runs.push_back(&run);
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

/// Of the starts that end at the lowest objective.
struct AtBest {
  std::size_t count = 0;
  double violation = 0;
  std::optional<double> eigenvalue;
  std::string strict;

  void add(const RecordedRun& run) {
    ++count;
    violation = std::max(violation, run.number("constraint_violation").value_or(0));
    const nlohmann::json answer = run.at("local_minimum.strict");
    const std::string text = answer.is_string() ? answer : "";
    if (strict.empty()) strict = text;
    if (text != strict) strict = "not all alike";
    if (const auto e = run.number("local_minimum.smallest_eigenvalue"))
      eigenvalue = std::min(eigenvalue.value_or(*e), *e);
  }
};

std::vector<Cell> cells_of(const TaskRuns& task) {
  std::size_t ran = 0;
  double best = std::numeric_limits<double>::infinity();
  std::vector<double> iterations, evaluations, milliseconds;
  const auto note = [](std::vector<double>& into, const std::optional<double>& value, double unit = 1) {
    if (value) into.push_back(unit * *value);
  };
  for (const RecordedRun* run : task.runs) {
    if (!run->has_result()) continue;
    ++ran;
    if (!run->is_optimal()) continue;
    best = std::min(best, run->number("objective").value_or(best));
    note(iterations, run->number("iterations"));
    const nlohmann::json passes = value_of(*run, "evaluations_of_f");
    if (passes.is_number()) evaluations.push_back(passes);
    note(milliseconds, run->number("seconds.solve"), 1e3);
  }
  AtBest at_best;
  for (const RecordedRun* run : task.runs)
    if (const auto f = run->number("objective"); run->is_optimal() && f && *f <= best + 1e-6 * std::abs(best))
      at_best.add(*run);
  const auto if_any = [&](double value) { return at_best.count ? std::optional(value) : std::nullopt; };
  const double starts =
      static_cast<double>(ran) / static_cast<double>(std::max<std::size_t>(at_best.count, 1));
  return {fmt::format("{}", ran),
          fmt::format("{}", at_best.count),
          Cell::of(if_any(starts), "{:.2f}"),
          spread(iterations, 0),
          spread(evaluations, 0),
          spread(milliseconds, 2),
          Cell::of(if_any(best), "{:.6g}"),
          Cell::of(if_any(at_best.violation), "{:.1e}"),
          at_best.strict,
          Cell::of(at_best.eigenvalue, "{:.3g}")};
}

Cell printed(const TaskRuns& task, const std::optional<Published>& published) {
  const nlohmann::json* row = published ? published->find(*task.runs.front()) : nullptr;
  return row ? cell_of(value_in(*row, "seconds"), "g", ", ") : Cell::none();
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
    std::vector<Cell> cells = {task.label};
    for (const char* name : {"model", "grid", "problem"}) cells.push_back(cell_of_column(first, name));
    for (Cell& cell : cells_of(task)) cells.push_back(std::move(cell));
    cells.push_back(printed(task, published));
    sheet.add(std::move(cells));
    for (const RecordedRun* run : task.runs) {
      const Cell seed = cell_of_column(*run, "asked.moment.seed");
      notes += note_of(*run, true,
                       seed.data.empty() ? task.label : fmt::format("{}, seed {}", task.label, seed.data));
    }
  }
  Tables tables{
      {{"", std::move(sheet), notes}},
      "at best: starts that end as optimal within 1e-6 of the lowest f of the task; restarts: starts "
      "for each of these;\n"
      "passes: over the rays, coarse ones included; strict, eigenvalue: the second-order "
      "condition, docs/quadric.md, section 3\n" +
          provenance_text(pointers(runs)) + '\n'};
  if (published)
    tables.legend +=
        fmt::format("paper: {}; {}\n", published->source, published->machine) +
        "the paper's machine, code and bodies are others, so its seconds tell nothing but the order "
        "of magnitude; an evaluation there is a mesh boolean\n";
  return tables;
}

}  // namespace kreisel::core
