#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/bench/commands.hpp"
#include "apps/shared/outputs.hpp"
#include "body/body.hpp"
#include "body/source.hpp"
#include "error.hpp"
#include "file/write_text.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/solid.hpp"
#include "problem/problem.hpp"

namespace kreisel::core::bench {
namespace {

using nlohmann::json;

/// A mesh before its repairs.
struct AsRead {
  std::string format;
  std::size_t vertices = 0, triangles = 0;
  MeshReport report;
};

/// What can be said of a solid. Millimetres, grams, model coordinates.
struct Solid {
  Vec3 extent, centre;
  double volume = 0, mass = 0;
  Vec3 principal;        ///< moments of inertia about the centre of mass, g mm^2, ascending
  Eigen::Matrix3d axes;  ///< columns, in that order
  std::vector<std::pair<std::string_view, Verdict>> verdicts;
};

/// What each problem says of the solid as it is.
std::vector<std::pair<std::string_view, Verdict>> verdicts(const Body& body, const Body& standing) {
  std::vector<std::pair<std::string_view, Verdict>> all;
  for (const ProblemEntry& entry : problems()) {
    if (!entry.for_solid) continue;
    const Body& posed = entry.upright ? standing : body;
    Verdict verdict;
    try {
      verdict = entry.make(*entry.for_solid, posed)->verify(posed.solid, posed.frame.length);
    } catch (const InputError& error) {  // no base to stand on; heavier than water
      verdict.text = error.what();
    }
    all.emplace_back(entry.name, verdict);
  }
  return all;
}

Solid look_at_solid(const Body& body) {
  Solid s;
  const double length = body.frame.length;
  s.extent = bounding_box(body.mesh).extent();
  s.volume = length * length * length * body.solid[S1];
  s.mass = body.density * s.volume * 1e-3;
  s.centre = body.frame.to_model(centre_of_mass(body.solid));
  const Eigen::Matrix3d& r = body.frame.rotation;
  // Moments are per solid mass and length^2; rotating back gives model axes.
  const Eigen::Matrix3d inertia =
      s.mass / body.solid[S1] * length * length * r.transpose() * inertia_about_centre(body.solid) * r;
  const PrincipalAxes principal(inertia);
  s.principal = principal.moments;
  s.axes = principal.axes;
  return s;
}

std::string text(const Vec3& v, const char* between = ", ") {
  return fmt::format("{:.6g}{}{:.6g}{}{:.6g}", v[0], between, v[1], between, v[2]);
}

void print_checks(const AsRead& as_read, Surface& s) {
  const MeshReport& r = as_read.report;
  fmt::print("  file       {}: {} vertices, {} triangles\n", as_read.format, as_read.vertices,
             as_read.triangles);
  fmt::print("  edges      {} open, {} of more than two triangles, {} along which two run the same way\n",
             r.open.count, r.crowded.count, r.misoriented.count);
  fmt::print("  triangles  {} using a vertex twice, {} without area, {} repeated\n", r.repeated_count,
             r.flat_count, r.duplicate_count);
  fmt::print("  vertices   {} equal to another, {} unused, {} at which parts merely touch\n",
             r.equal_vertex_count, r.unused_vertex_count, r.pinched_vertex_count);
  if (s.repairs().lines.empty()) fmt::print("  repairs    none\n");
  for (const std::string& line : s.repairs().lines) fmt::print("  repaired   {}\n", line);
  const auto& pairs = s.crossings();
  fmt::print(
      "  crossings  {} pairs of triangles run through each other{}\n", pairs.size(),
      pairs.empty() ? "" : fmt::format(", the first {} and {}", pairs.front()[0] + 1, pairs.front()[1] + 1));
}

void print_shells(Surface& s) {
  constexpr std::size_t most_lines = 20;
  const auto& shells = s.shells();
  fmt::print("  shells     {}\n", shells.size());
  for (std::size_t i = 0; i < shells.size() && i < most_lines; ++i) {
    const Shell& shell = shells[i];
    fmt::print("    {:<8} {} triangles, {}, Euler characteristic {}{}, volume {:.6g}{}\n", i + 1,
               shell.triangles.size(), shell.closed ? "closed" : "open", shell.euler,
               shell.genus ? fmt::format(", genus {}", *shell.genus) : "", shell.volume,
               s.enclosing()[i].empty() ? "" : fmt::format(", inside {} other", s.enclosing()[i].size()));
  }
  if (shells.size() > most_lines) fmt::print("    and {} more\n", shells.size() - most_lines);
}

void print_solid(const Solid& s, double density) {
  fmt::print("as a solid of {:.4g} g/cm^3\n", density);
  fmt::print("  extent     {} mm\n", text(s.extent, " x "));
  fmt::print("  volume     {:.6g} mm^3, mass {:.6g} g\n", s.volume, s.mass);
  fmt::print("  centre     {} mm\n", text(s.centre));
  for (int k = 0; k < 3; ++k)
    fmt::print("  principal  {:.6g} g mm^2 about {}\n", s.principal[k], text(s.axes.col(k)));
  for (const auto& [name, verdict] : s.verdicts)
    fmt::print("  {:<10} {}: {}\n", name, verdict.ok ? "yes" : "no", verdict.text);
}

json array(const Vec3& v) { return {v[0], v[1], v[2]}; }

json to_json(const AsRead& as_read, Surface& s) {
  const MeshReport& r = as_read.report;
  const auto& pairs = s.crossings();
  json shells = json::array();
  for (std::size_t i = 0; i < s.shells().size(); ++i) {
    const Shell& shell = s.shells()[i];
    shells.push_back({{"triangles", shell.triangles.size()},
                      {"closed", shell.closed},
                      {"euler", shell.euler},
                      {"genus", shell.genus ? json(*shell.genus) : json()},
                      {"volume", shell.volume},
                      {"depth", s.enclosing()[i].size()}});
  }
  return {{"format", as_read.format},
          {"vertices", as_read.vertices},
          {"triangles", as_read.triangles},
          {"checks",
           {{"open_edges", r.open.count},
            {"crowded_edges", r.crowded.count},
            {"misoriented_edges", r.misoriented.count},
            {"repeated_vertex_triangles", r.repeated_count},
            {"flat_triangles", r.flat_count},
            {"duplicate_triangles", r.duplicate_count},
            {"equal_vertices", r.equal_vertex_count},
            {"unused_vertices", r.unused_vertex_count},
            {"pinched_vertices", r.pinched_vertex_count},
            {"self_intersections", pairs.size()},
            {"first_self_intersection", pairs.empty() ? json() : json(pairs.front())}}},
          {"repairs", s.repairs().lines},
          {"shells", shells}};
}

json to_json(const Solid& s) {
  json axes = json::array(), verdicts = json::object();
  for (int k = 0; k < 3; ++k) axes.push_back(array(s.axes.col(k)));
  for (const auto& [name, verdict] : s.verdicts)
    verdicts[std::string(name)] = {{"ok", verdict.ok}, {"text", verdict.text}, {"values", verdict.values}};
  return {{"extent_mm", array(s.extent)},
          {"volume_mm3", s.volume},
          {"mass_g", s.mass},
          {"centre_of_mass_mm", array(s.centre)},
          {"principal_moments_g_mm2", array(s.principal)},
          {"principal_axes", axes},
          {"verified", verdicts}};
}

}  // namespace

int inspect_model(const InspectOptions& options) {
  const BodySpec& spec = options.config.body;
  require_writable(options.json_file, "--json");
  const bool only_json = options.json_file == "-";
  Source source = load_source(spec);
  const AsRead as_read{source.format, source.mesh.vertices.size(), source.mesh.triangles.size(),
                       inspect(source.mesh)};
  Surface surface(std::move(source.mesh));
  json summary = to_json(as_read, surface);
  summary["model"] = spec.model;
  if (!only_json) {
    fmt::print("{}\n", spec.model);
    print_checks(as_read, surface);
    print_shells(surface);
  }
  std::exception_ptr refusal;
  summary["solid"] = summary["error"] = nullptr;
  try {
    device::Device device(options.config.device);
    source = as_solid(std::move(source), surface, spec.model);
    BodySpec upright = spec;
    upright.stands_upright = true;
    const Body body = make_body(spec, source, device);
    Solid solid = look_at_solid(body);
    solid.verdicts = verdicts(body, make_body(upright, source, device));
    summary["repairs"] = body.repairs;
    summary["solid"] = to_json(solid);
    if (!only_json) print_solid(solid, body.density);
  } catch (const InputError& error) {  // also for the JSON, which is written first
    summary["error"] = error.what();
    refusal = std::current_exception();
  }
  const std::string written = summary.dump(2) + "\n";
  if (only_json) fmt::print("{}", written);
  if (!only_json && !options.json_file.empty()) write_text(options.json_file, written);
  std::fflush(stdout);  // ahead of the error
  if (refusal) std::rethrow_exception(refusal);
  return done;
}

}  // namespace kreisel::core::bench
