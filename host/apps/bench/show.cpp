#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <vector>

#include "apps/bench/commands.hpp"
#include "error.hpp"
#include "table/row.hpp"

namespace kreisel::core::bench {
namespace {

using Lines = std::vector<const char*>;

/// Patterns of text_of(): a line without its values is not there.
const Lines& lines_of(RecordKind kind) {
  static const Lines of_run = {
      "  run        {model} {grid.0} x {grid.1} x {grid.2}, {problem} by {formulation} with {solver}: {rays} "
      "rays, {interior_voxels} voxels, {variables} variables",
      "  possible   {scope}",
      "  solve      {termination} ({message}), {iterations} iterations, objective {objective:.6f}, violation "
      "{violation:.1e}",
      "  minimum    strict local minimum: {local_minimum.strict}, smallest eigenvalue "
      "{local_minimum.smallest_eigenvalue:.3g} ||   minimum    strict local minimum: {local_minimum.strict}",
      "  infeasible {infeasibility}",
      "  time       {seconds.solve:.3f} s solve ({seconds.kernels:.3f} s in kernels), {seconds.setup:.3f} s "
      "set-up; median of {samples}",
      "  certified  f >= {bound:.6f}, gap {gap_percent:.3g} %",
      "  rounded    objective {rounding.objective:.6f}, violation {rounding.constraint_violation:.1e}, "
      "{rounding.mended_voxels} voxels mended, {rounding.moved_voxels} moved",
      "  verified   {verified.text|no_part}"};
  static const Lines of_map = {
      "  {model}: map of {problem}, axes through {through}, {axes_answered} of {axes_asked} axes, grid "
      "{grid.0}x{grid.1}x{grid.2}, {rays} rays, {seconds.sweep:.3f} s",
      "  make it    {best.command}"};
  static const Lines of_nesting = {
      "  {shapes}: {kind}, {outer_triangles} + {inner_triangles} triangles",
      "  answer     {text} ({termination})",
      "  scale      {scale:.6g}",
      "  certified  {certified_scale:.6g}",
      "  sampled    {sampled_scale:.6g}",
      "  time       {seconds.search:.3f} s test or search ({evaluations} evaluations), {seconds.setup:.3f} s "
      "set-up"};
  static const Lines of_simulation = {"  {model}: {problem}, solid and part in motion",
                                      "  motion     {contact}, {rpm:.0f} rpm from a tilt of {tilt_degrees} "
                                      "degrees, {seconds:.3g} s"};
  const Lines* const all[] = {&of_run, &of_map, &of_nesting, &of_simulation};
  return *all[static_cast<std::size_t>(kind)];
}

/// What a record has several of: a line each.
void print_items(const Row& row, const char* list, const char* pattern) {
  const nlohmann::json items = row.runs.front()->at(list);
  for (const auto& [key, item] : items.items()) {
    Row one = row;
    one.item = item;
    one.item["key"] = key;
    if (const auto line = text_of(one, pattern)) fmt::print("{}\n", *line);
  }
}

void print(const Record& record) {
  const RecordedRun run{{}, record};
  const Row row{{&run}};
  fmt::print("{}\n", record.path.string());
  if (!record.error.empty()) {
    fmt::print("  failed     {}\n", record.error);
    return;
  }
  for (const char* pattern : lines_of(record.kind))
    if (const auto line = text_of(row, pattern)) fmt::print("{}\n", *line);
  print_items(row, "cases",
              "  {item.draft|'possible'}: {100 * item.feasible / axes_answered:.1f} % feasible, "
              "{100 * item.ok / axes_answered:.1f} % do it");
  print_items(row, "timings",
              "  {item.key}: {item.test_ms:.4g} ms a test, {item.search_ms:.4g} ms a search, "
              "which finds {item.scale:.6g}");
  for (const char* body : {"solid", "part"})
    if (const auto line = text_of(row, fmt::format("  {0:<10} {{{0}.text}} || ", body));
        line && !line->empty())
      fmt::print("{}\n", *line);
  if (const auto line = text_of(row, "  made       {provenance.started} by {commit} on {device}"))
    fmt::print("{}\n", *line);
  fmt::print("  config    ");
  for (const auto& [key, value] : record.config()) fmt::print(" {}={}", key, value);
  fmt::print("\n");
}

}  // namespace

int show(const ShowOptions& options) {
  std::vector<std::filesystem::path> records;
  for (const std::string& path : options.paths)
    std::ranges::copy(records_in(path), std::back_inserter(records));
  if (!options.columns.empty()) return show_columns(options, records);
  if (!options.json_file.empty()) throw InputError("--json without --columns; expected both");
  for (const std::filesystem::path& record : records) print(read_record(record));
  return done;
}

}  // namespace kreisel::core::bench
