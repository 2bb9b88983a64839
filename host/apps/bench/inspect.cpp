#include "session/inspect.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/bench/commands.hpp"
#include "apps/shared/outputs.hpp"
#include "apps/shared/step_line.hpp"
#include "error.hpp"
#include "file/write_text.hpp"
#include "run/inspection_json.hpp"
#include "stop.hpp"

namespace kreisel::core::bench {
namespace {

using nlohmann::json;

std::string text(const Vec3& v, const char* between = ", ") {
  return fmt::format("{:.6g}{}{:.6g}{}{:.6g}", v[0], between, v[1], between, v[2]);
}

/// Of a place: six digits, and thousandths of a millimetre however far from the origin.
std::string place_text(const Vec3& v) {
  return v.cwiseAbs().maxCoeff() < 1e3 ? text(v) : fmt::format("{:.3f}, {:.3f}, {:.3f}", v[0], v[1], v[2]);
}

void print_checks(const Inspection& seen) {
  const auto& n = seen.checks;
  fmt::print("  file       {}: {} vertices, {} triangles\n", seen.format, seen.vertices, seen.triangles);
  fmt::print("  edges      {} open, {} of more than two triangles, {} along which two run the same way\n",
             n.at("open_edges"), n.at("crowded_edges"), n.at("misoriented_edges"));
  fmt::print("  triangles  {} using a vertex twice, {} without area, {} repeated\n",
             n.at("repeated_vertex_triangles"), n.at("flat_triangles"), n.at("duplicate_triangles"));
  fmt::print("  vertices   {} equal to another, {} unused, {} at which parts merely touch\n",
             n.at("equal_vertices"), n.at("unused_vertices"), n.at("pinched_vertices"));
  if (seen.repairs.empty()) fmt::print("  repairs    none\n");
  for (const std::string& line : seen.repairs) fmt::print("  repaired   {}\n", line);
  const auto& first = seen.first_crossing;
  fmt::print("  crossings  {} pairs of triangles run through each other{}\n", n.at("self_intersections"),
             first ? fmt::format(", the first {} and {}", (*first)[0] + 1, (*first)[1] + 1) : "");
}

void print_shells(const Inspection& seen) {
  constexpr std::size_t most_lines = 20;
  fmt::print("  shells     {}\n", seen.shells.size());
  for (std::size_t i = 0; i < seen.shells.size() && i < most_lines; ++i) {
    const ShellReport& shell = seen.shells[i];
    fmt::print("    {:<8} {} triangles, {}, Euler characteristic {}{}, volume {:.6g}{}\n", i + 1,
               shell.triangles, shell.closed ? "closed" : "open", shell.euler,
               shell.genus ? fmt::format(", genus {}", *shell.genus) : "", shell.volume,
               shell.depth == 0 ? "" : fmt::format(", inside {} other", shell.depth));
  }
  if (seen.shells.size() > most_lines) fmt::print("    and {} more\n", seen.shells.size() - most_lines);
}

void print_solid(const SolidReport& s, double density) {
  fmt::print("as a solid of {:.4g} g/cm^3\n", density);
  fmt::print("  extent     {} mm\n", text(s.extent, " x "));
  fmt::print("  volume     {:.6g} mm^3, mass {:.6g} g\n", s.volume, s.mass);
  if (s.pieces.size() > 1) {
    constexpr std::size_t most = 8;
    const std::vector<double> first(s.pieces.begin(),
                                    s.pieces.begin() + std::ptrdiff_t(std::min(most, s.pieces.size())));
    fmt::print("  pieces     {} that do not touch: {:.6g}{} g; what follows takes them as one rigid body\n",
               s.pieces.size(), fmt::join(first, ", "), s.pieces.size() > most ? ", ..." : "");
  }
  fmt::print("  centre     {} mm\n", place_text(s.centre));
  for (int k = 0; k < 3; ++k)
    fmt::print("  principal  {:.6g} g mm^2 about {}\n", s.principal[k], text(s.axes.col(k)));
  constexpr std::size_t most_rests = 8;
  for (std::size_t i = 0; i < s.rests.size() && i < most_rests; ++i)
    fmt::print("  rest:{:<5} {:.1f} % of drops, up {}, on {:.4g} mm^2, topples at {:.2f} degrees\n", i + 1,
               100 * s.rests[i].probability, text(s.rests[i].up), s.rests[i].area, s.rests[i].tilt_degrees);
  if (s.rests.size() > most_rests)
    fmt::print("             and {} more ways of lying\n", s.rests.size() - most_rests);
  for (const auto& [name, verdict] : s.verdicts)
    fmt::print("  {:<10} {}: {}\n", name, verdict.ok ? "yes" : "no", verdict.text);
}

}  // namespace

int inspect_model(const InspectOptions& options) {
  const BodySpec& spec = options.config.body;
  require_writable(options.json_file, "--json");
  const Inspection seen = [&] {
    const apps::StepLine line;
    const Control control = line.control();
    const StopScope scope(control.stop);
    control.tell("read");
    return inspect(load_source(spec), spec, control);
  }();
  json summary = json_of(seen);
  summary["model"] = spec.model;
  // Names of files may be any bytes, and JSON is UTF-8.
  const std::string written = summary.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
  if (options.json_file == "-") {
    fmt::print("{}", written);
  } else {
    fmt::print("{}\n", spec.model);
    print_checks(seen);
    print_shells(seen);
    if (seen.solid) print_solid(*seen.solid, spec.density);
    if (!options.json_file.empty()) write_text(options.json_file, written);
  }
  std::fflush(stdout);  // ahead of the error
  if (!seen.solid) throw InputError(seen.error);
  return done;
}

}  // namespace kreisel::core::bench
