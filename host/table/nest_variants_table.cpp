#include "table/nest_variants_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include "statistics.hpp"
#include "table/experiment_run.hpp"
#include "table/table_parts.hpp"

namespace kreisel::core {
namespace {

/// All seeds of one setting.
struct Seeds {
  std::string setting;
  std::vector<double> scales, sampled, seconds,
      evaluations;  ///< of those that ended with a nesting or without one
};

Sheet empty_sheet(bool paper) {
  std::vector<Sheet::Column> columns({{"shapes", "", ""},
                                      {"setting", "", "setting", true},
                                      {"seeds", "", "seeds"},
                                      {"evaluations", "median", "evaluations"},
                                      {"seconds", "median", "seconds"},
                                      {"median", "scale", "median"},
                                      {"least", "scale", "least"},
                                      {"lower_quartile", "scale", "lower quartile"},
                                      {"upper_quartile", "scale", "upper quartile"},
                                      {"best", "scale", "best"},
                                      {"near_best", "", "near the best of all"}});
  if (paper) columns.push_back({"reach_paper", "", "reach the paper's"});
  return Sheet(std::move(columns));
}

std::string shapes_in(const RecordedRun& run) { return fields_of(run.run).at("shapes"); }

/// The runs of each pair of shapes, by their numbers; in the order of the runs.
std::vector<std::pair<std::string, std::vector<std::size_t>>> by_shapes(
    const std::vector<RecordedRun>& runs) {
  std::vector<std::pair<std::string, std::vector<std::size_t>>> all;
  std::unordered_map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto [at, is_new] = known.try_emplace(shapes_in(runs[i]), all.size());
    if (is_new) all.push_back({at->first, {}});
    all[at->second].second.push_back(i);
  }
  return all;
}

/// Why a run has no result; empty where it has one.
std::string note_of_nesting(const RecordedRun& run) {
  if (run.has_result()) return {};
  return fmt::format("{}: {}\n", run_text(run.run), run.record ? "error - " + run.record->error : "not run");
}

/// What a paper reaches with the same outer shape.
std::optional<double> printed_scale(const std::string& shapes, const std::optional<Published>& published) {
  if (!published) return std::nullopt;
  for (const nlohmann::json& row : published->rows)
    if (row.contains("nesting") && shapes == fmt::format("{0} in {0}", row.at("model").get<std::string>()))
      return row.at("nesting").at("scale").get<double>();
  return std::nullopt;
}

std::vector<Cell> row_of(const Seeds& seeds, const std::string& shapes, double best) {
  const auto near = std::ranges::count_if(seeds.scales, [&](double s) { return s >= 0.98 * best; });
  const auto scale = [&](double share) { return Cell::of(quantile(seeds.scales, share), "{:.4f}"); };
  return {shapes,
          seeds.setting,
          fmt::format("{}", seeds.scales.size()),
          Cell::of(quantile(seeds.evaluations, 0.5), "{:.0f}"),
          Cell::of(quantile(seeds.seconds, 0.5), "{:.1f}"),
          scale(0.5),
          scale(0),
          scale(0.25),
          scale(0.75),
          scale(1),
          fmt::format("{}", near)};
}

}  // namespace

std::vector<std::string> settings_of_search(const std::vector<RecordedRun>& runs) {
  std::vector<std::map<std::string, std::string>> all;
  for (const RecordedRun& run : runs) {
    auto& fields = all.emplace_back(fields_of(run.run));
    for (const char* key : {"outer", "inner", "seed", "shapes"}) fields.erase(key);
  }
  auto shared = all.empty() ? std::map<std::string, std::string>() : all.front();
  for (const auto& fields : all)
    std::erase_if(shared, [&](const auto& field) {
      const auto at = fields.find(field.first);
      return at == fields.end() || at->second != field.second;
    });
  std::vector<std::string> settings;
  for (const auto& fields : all) {
    std::vector<std::string> parts;
    for (const auto& field : fields)
      if (!shared.contains(field.first)) parts.push_back(fmt::format("{} = {}", field.first, field.second));
    settings.push_back(parts.empty() ? "defaults" : fmt::format("{}", fmt::join(parts, ", ")));
  }
  return settings;
}

Tables nest_variants_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>& published) {
  std::vector<std::string> settings = settings_of_search(runs);
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (!runs[i].run.label.empty()) settings[i] = runs[i].run.label;
  Tables tables;
  for (const auto& [shapes, members] : by_shapes(runs)) {
    std::vector<Seeds> rows;
    std::unordered_map<std::string, std::size_t> known;
    std::string notes;
    double best = 0;
    for (const std::size_t i : members) {
      const RecordedRun& run = runs[i];
      notes += note_of_nesting(run);
      if (!run.has_result()) continue;
      const auto [place, is_new] = known.try_emplace(settings[i], rows.size());
      if (is_new) rows.push_back({settings[i], {}, {}, {}, {}});
      Seeds* at = &rows[place->second];
      const double scale = run.at("valid") == true ? run.number("scale").value_or(0) : 0;
      at->scales.push_back(scale);
      at->sampled.push_back(run.number("sampled_scale").value_or(0));
      at->seconds.push_back(run.number("seconds.search").value_or(0));
      at->evaluations.push_back(run.number("evaluations").value_or(0));
      best = std::max(best, scale);
    }
    std::ranges::stable_sort(rows, std::greater(),
                             [](const Seeds& seeds) { return quantile(seeds.scales, 0.5); });
    Sheet sheet = empty_sheet(published.has_value());
    const std::optional<double> paper = printed_scale(shapes, published);
    for (const Seeds& seeds : rows) {
      std::vector<Cell> cells = row_of(seeds, shapes, best);
      const auto reach =
          std::ranges::count_if(seeds.sampled, [&](double s) { return s >= paper.value_or(0); });
      if (published) cells.push_back(paper ? Cell(fmt::format("{}", reach)) : Cell::none());
      sheet.add(std::move(cells));
    }
    tables.blocks.push_back({fmt::format("{}, best of all {:.4f}", shapes, best), std::move(sheet), notes});
  }
  tables.legend =
      "the setting with the highest median first; near the best of all: seeds within 2 % of it\n" +
      provenance_text(pointers(runs)) + '\n';
  if (published)
    tables.legend += fmt::format(
        "reach the paper's: seeds whose nesting views of 512 x 512 pixels call valid at a scale no "
        "less; paper: {}\n",
        published->source);
  return tables;
}

}  // namespace kreisel::core
