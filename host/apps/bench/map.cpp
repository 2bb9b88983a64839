#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/bench/commands.hpp"
#include "apps/shared/outputs.hpp"
#include "apps/shared/step_line.hpp"
#include "problem/problem.hpp"
#include "record/map_record.hpp"
#include "record/record.hpp"
#include "session/orientation_map.hpp"

namespace kreisel::core::bench {
namespace {

std::string share(std::size_t part, std::size_t whole) {
  return fmt::format("{} ({:.1f} %)", part,
                     whole ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0);
}

void print_map(const OrientationMap& map) {
  const std::size_t n = map.axes.size();
  const ProblemEntry& asked = find_problem(map.config.problem);
  const std::string setting = asked.map.value_or(MapCases{}).setting;
  const bool spins = !asked.upright, cases = !setting.empty();
  fmt::print("{}: map of {} on {}{}\n", map.body_name, map.config.problem, map.provenance.device,
             map.provenance.single_precision ? " (single precision, compensated)" : "");
  fmt::print("  domain     {} {} x {} x {} of {:.4g} mm, wall {} = {:.4g} mm: {} rays\n", map.domain,
             map.grid.n[0], map.grid.n[1], map.grid.n[2], map.grid.h * map.length_mm,
             to_string(map.config.wall), map.wall * map.length_mm, map.rays);
  const char* through = !spins                           ? ""
                        : map.through == Through::centre ? " through the solid's centre of mass, on a peg"
                                                         : " through the lowest point";
  fmt::print("  axes       {}{}{}\n", n, n < map.asked ? fmt::format(" of {}, interrupted", map.asked) : "",
             through);
  fmt::print("  time       {:.3f} s sweep, {:.3f} s set-up\n", map.sweep_seconds, map.setup_seconds);
  for (std::size_t c = 0; c < map.cases.size(); ++c) {
    const std::size_t undecided = map.count(c, MapAnswer::undecided);
    fmt::print("  {:<10} {} feasible, {} {}{}\n", cases ? setting + " " + map.cases[c] : "possible",
               share(map.count(c, MapAnswer::feasible), n), share(map.count_ok(c), n),
               asked.verb.empty() ? asked.name : asked.verb,
               undecided ? fmt::format(", {} undecided", share(undecided, n)) : "");
  }
  const auto best = map.best();
  if (!best) {
    fmt::print("  best       none: no axis is feasible\n");
    return;
  }
  const MapAnswer& answer = map.at(best->axis, best->at_case);
  const Vec3& a = map.axes[best->axis];
  fmt::print("  best       axis {:.4f},{:.4f},{:.4f}{}: objective {:.6f}, {}\n", a[0], a[1], a[2],
             cases ? fmt::format(" at {} {}", setting, map.cases[best->at_case]) : "", answer.objective,
             answer.verdict.text);
  fmt::print("  make it    {}\n", map.command(*best));
}

}  // namespace

int map_model(const MapOptions& options) {
  require_writable(options.json_file, "--json");
  require_writable(options.record_file, "--record");
  const MapSpec spec = map_spec(options.run);
  OrientationMap map;
  {
    const StepLine line;
    Session session;
    map = map_orientations(session, spec, line.control());
  }
  if (!options.record_file.empty()) write_map(options.record_file, map);
  const std::string json = to_json(map).dump(2) + "\n";
  if (options.json_file == "-") {
    fmt::print("{}", json);  // alone on standard output, for a pipe
  } else {
    if (!options.json_file.empty()) write_text(options.json_file, json);
    print_map(map);
  }
  if (map.axes.size() < map.asked) return was_interrupted;
  return map.best() ? done : infeasible;
}

}  // namespace kreisel::core::bench
