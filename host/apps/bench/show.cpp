#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/bench/commands.hpp"
#include "record/map_record.hpp"
#include "record/nest_record.hpp"
#include "record/record.hpp"
#include "record/records_in.hpp"

namespace kreisel::core::bench {
namespace {

void print(const RecordSummary& r) {
  fmt::print("{}\n", r.path.string());
  if (!r.error.empty()) {
    fmt::print("  failed     {}\n", r.error);
    return;
  }
  fmt::print("  run        {} {} x {} x {}, {} by {} with {}: {} rays, {} voxels, {} variables\n", r.model,
             r.grid[0], r.grid[1], r.grid[2], r.problem, r.formulation, r.solver, r.rays, r.interior_voxels,
             r.variables);
  if (!r.scope.empty()) fmt::print("  possible   {}\n", r.scope);
  fmt::print("  solve      {} ({}), {} iterations, objective {:.6f}, violation {:.1e}\n", r.termination,
             r.message, r.iterations, r.objective, r.violation);
  if (!r.strict_minimum.empty())
    fmt::print("  minimum    strict local minimum: {}{}\n", r.strict_minimum,
               std::isfinite(r.smallest_eigenvalue.value_or(std::nan("")))
                   ? fmt::format(", smallest eigenvalue {:.3g}", *r.smallest_eigenvalue)
                   : "");
  if (!r.infeasibility.empty()) fmt::print("  infeasible {}\n", r.infeasibility);
  fmt::print("  time       {:.3f} s solve ({:.3f} s in kernels), {:.3f} s set-up; median of {}\n",
             r.median.solve, r.median.kernels, r.median.setup, r.samples.size());
  if (r.bound && r.gap) fmt::print("  certified  f >= {:.6f}, gap {:.3g} %\n", *r.bound, 100 * *r.gap);
  if (r.has_part)
    fmt::print("  rounded    objective {:.6f}, violation {:.1e}, {} voxels mended, {} moved\n",
               r.rounded_objective, r.rounded_violation, r.mended_voxels, r.moved_voxels);
  fmt::print("  verified   {}\n", r.verified_text);
  fmt::print("  made       {} by {} on {}\n", r.started, r.commit, r.device);
  fmt::print("  config    ");
  for (const auto& [key, value] : r.config) fmt::print(" {}={}", key, value);
  fmt::print("\n");
}

void print(const MapSummary& map) {
  fmt::print("{}\n", map.path.string());
  fmt::print("  {}: map of {}{}, {} of {} axes, grid {}x{}x{}, {} rays, {:.3f} s\n", map.model, map.problem,
             !find_problem(map.problem).upright ? " through " + map.through : "", map.axes, map.asked, map.grid[0],
             map.grid[1], map.grid[2], map.rays, map.sweep_seconds);
  for (const MapSummary::Case& part : map.cases)
    fmt::print("  {:<10} {:.1f} % feasible, {:.1f} % {}\n",
               part.draft.empty() ? "possible" : "draft " + part.draft, 100 * part.feasible, 100 * part.ok,
               map.problem);
  if (map.best) fmt::print("  make it    {}\n", map.best->command);
  fmt::print("  made       {} by {} on {}\n", map.started, map.commit, map.device);
}

void print(const NestSummary& nest) {
  fmt::print("{}\n", nest.path.string());
  if (!nest.error.empty()) {
    fmt::print("  failed     {}\n", nest.error);
    return;
  }
  fmt::print("  {}: {}, {} + {} triangles\n", nest.shapes, nest.kind, nest.outer_triangles,
             nest.inner_triangles);
  fmt::print("  answer     {} ({})\n", nest.text, nest.termination);
  if (nest.valid) fmt::print("  scale      {:.6g}\n", nest.scale);
  if (nest.certified_scale) fmt::print("  certified  {:.6g}\n", *nest.certified_scale);
  if (nest.sampled_scale) fmt::print("  sampled    {:.6g}\n", *nest.sampled_scale);
  fmt::print("  time       {:.3f} s test or search ({} evaluations), {:.3f} s set-up\n", nest.search_seconds,
             nest.evaluations, nest.setup_seconds);
  for (const NestTiming& t : nest.timings)
    fmt::print("  {:<10} {:.4g} ms a test, {:.4g} ms a search, which finds {:.6g}\n", t.variant, t.test_ms,
               t.search_ms, t.scale);
  fmt::print("  made       {} by {} on {}\n", nest.started, nest.commit, nest.device);
  fmt::print("  config    ");
  for (const auto& [key, value] : nest.config) fmt::print(" {}={}", key, value);
  fmt::print("\n");
}

}  // namespace

int show(const std::vector<std::string>& paths) {
  for (const std::string& path : paths)
    for (const std::filesystem::path& record : records_in(path)) {
      const RecordKind kind = kind_of_record(record);
      if (kind == RecordKind::map)
        print(read_map(record));
      else if (kind == RecordKind::nesting)
        print(read_nest(record));
      else
        print(read_record(record));
    }
  return done;
}

}  // namespace kreisel::core::bench
