#include "experiment/nest_table.hpp"

#include <algorithm>

#include "experiment/nest_table_parts.hpp"

namespace kreisel::core {
namespace {

constexpr std::array timed = {"peel", "envelope", "hybrid"};

Sheet empty_sheet(bool timings, bool paper) {
  std::vector<Sheet::Column> columns = {{"label", "", "label", true},
                                        {"shapes", "", "shapes", true},
                                        {"triangles", "", "triangles"},
                                        {"free", "", "free", true},
                                        {"evaluations", "", ""}};
  if (timings) {
    for (const std::string variant : timed) columns.push_back({variant + "_test_ms", "ms a test", variant});
    for (const std::string variant : timed)
      columns.push_back({variant + "_search_ms", "ms a scale search", variant});
  }
  columns.insert(columns.end(), {{"setup_seconds", "", ""},
                                 {"search_seconds", "", ""},
                                 {"certify_seconds", "", ""},
                                 {"seconds", "", "seconds"},
                                 {"scale", "scale", "found"},
                                 {"certified_scale", "scale", "certified"},
                                 {"sampled_scale", "scale", "sampled"}});
  if (paper)
    columns.insert(columns.end(), {{"paper_triangles", "paper", "triangles"},
                                   {"paper_test_ms", "paper", "ms a test"},
                                   {"paper_search_ms", "paper", "ms a search"},
                                   {"paper_seconds", "paper", "seconds"},
                                   {"paper_scale", "paper", "scale"}});
  columns.insert(columns.end(), {{"device", "", ""}, {"commit", "", ""}});
  return Sheet(std::move(columns));
}

const NestTiming* timing_of(const NestSummary& nest, const std::string& variant) {
  const auto at = std::ranges::find(nest.timings, variant, &NestTiming::variant);
  return at == nest.timings.end() ? nullptr : &*at;
}

const PublishedRow::Nesting* printed_nesting(const RecordedRun& run,
                                             const std::optional<Published>& published) {
  if (!published) return nullptr;
  const auto at = std::ranges::find_if(published->rows, [&](const PublishedRow& row) {
    return row.nesting && (run.run.label == row.label || run.run.label.starts_with(row.label + ","));
  });

  return at == published->rows.end() ? nullptr : &*at->nesting;
}

void add_timings(std::vector<Cell>& cells, const NestSummary& nest) {
  for (double NestTiming::*const of : {&NestTiming::test_ms, &NestTiming::search_ms})
    for (const char* variant : timed) {
      const NestTiming* timing = timing_of(nest, variant);
      cells.push_back(timing ? Cell::of(timing->*of, "{:.3g}") : Cell::none());
    }
}

std::vector<Cell> row_of(const RecordedRun& run, bool timings) {
  const NestSummary& nest = *run.nest;
  std::vector<Cell> cells = {run.run.label, nest.shapes,
                             fmt::format("{}", nest.outer_triangles + nest.inner_triangles),
                             text_of(run.run.run, "free"), fmt::format("{}", nest.evaluations)};
  if (timings) add_timings(cells, nest);
  const double seconds = nest.setup_seconds + nest.search_seconds + nest.certify_seconds;
  cells.insert(cells.end(),
               {fmt::format("{}", nest.setup_seconds), fmt::format("{}", nest.search_seconds),
                fmt::format("{}", nest.certify_seconds), Cell::of(seconds, "{:.2f}"),
                Cell::of(nest.valid ? std::optional(nest.scale) : std::nullopt, "{:.4f}"),
                Cell::of(nest.certified_scale, "{:.4f}"), Cell::of(nest.sampled_scale, "{:.4f}")});
  return cells;
}

}  // namespace

Tables nestings_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>& published) {
  const bool timings = std::ranges::any_of(
      runs, [](const RecordedRun& run) { return has_nesting(run) && !run.nest->timings.empty(); });
  Sheet sheet = empty_sheet(timings, published.has_value());
  std::string notes;
  for (const RecordedRun& run : runs) {
    notes += note_of_nesting(run);
    if (!has_nesting(run)) continue;
    std::vector<Cell> cells = row_of(run, timings);
    const bool stand_in = run.run.label.find("stand-in") != std::string::npos;
    if (const PublishedRow::Nesting* paper = printed_nesting(run, published))
      cells.insert(cells.end(), {fmt::format("{}", paper->triangles), Cell::of(paper->test_ms, "{:g}"),
                                 Cell::of(paper->search_ms, "{:g}"), Cell::of(paper->seconds, "{:g}"),
                                 stand_in ? Cell(fmt::format("({:.2f})", paper->scale), "")
                                          : Cell::of(paper->scale, "{:.2f}")});
    else if (published)
      cells.insert(cells.end(), 5, Cell::none());
    cells.insert(cells.end(), {run.nest->device, run.nest->commit});
    sheet.add(std::move(cells));
  }
  Tables tables{
      {{"", std::move(sheet), notes}},
      "seconds: set-up, search and certification, wall; found: by the search; certified: the largest near it "
      "that the exact test confirms, to 1e-4;\nsampled: the largest that views of 512 x 512 pixels call "
      "valid, which is what the paper measures; a test: at 0.98 of the scale found\n" +
          provenance_of_nestings(runs)};
  if (published)
    tables.legend += fmt::format(
        "paper: {}; {}\nstand-in: another shape than the paper's, whose scale in parentheses is no measure "
        "of "
        "it\n",
        published->source, published->machine);
  return tables;
}

Tables nest_accuracy_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&) {
  Tables tables;
  for (const RecordedRun& run : runs) {
    Sheet sheet({{"shapes", "", ""},
                 {"resolution", "", "pixels"},
                 {"placements", "", ""},
                 {"nested", "", ""},
                 {"median", "sampled scale less exact", "median"},
                 {"percentile_95", "sampled scale less exact", "95 %"},
                 {"largest", "sampled scale less exact", "largest"},
                 {"optimistic", "of the placements", "above"},
                 {"pessimistic", "of the placements", "below"},
                 {"missed", "of the placements", "missed"}});
    std::string heading = shapes_text(run.run.nesting());
    if (has_nesting(run) && run.nest->accuracy) {
      const nest::Accuracy& found = *run.nest->accuracy;
      heading += fmt::format(
          ": {} of {} random placements nest at some scale; exact agrees with hybrid on {}; peeling differs "
          "from envelopes in {} of {} pixels",
          found.nested, found.placements, found.exact_agrees, found.peel_disagrees, found.pixels);
      for (const nest::SampledError& e : found.errors)
        sheet.add({shapes_text(run.run.nesting()), fmt::format("{}", e.resolution),
                   fmt::format("{}", found.placements), fmt::format("{}", found.nested),
                   Cell::of(e.median, "{:.2g}"), Cell::of(e.most_of, "{:.2g}"), Cell::of(e.largest, "{:.2g}"),
                   fmt::format("{}", e.optimistic), fmt::format("{}", e.pessimistic),
                   fmt::format("{}", e.missed)});
    }
    tables.blocks.push_back({heading, std::move(sheet), note_of_nesting(run)});
  }
  tables.legend =
      "above, below: by more than 1e-4; missed: bisection found no valid scale where there is one, because "
      "feasibility is not monotonic\n" +
      provenance_of_nestings(runs);
  return tables;
}

}  // namespace kreisel::core
