#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/bench/commands.hpp"
#include "apps/bench/outputs.hpp"
#include "body/body.hpp"
#include "body/source.hpp"
#include "error.hpp"
#include "file/write_text.hpp"
#include "mesh/check.hpp"
#include "mesh/components.hpp"
#include "mesh/repair.hpp"
#include "mesh/self_intersections.hpp"
#include "problem/problem.hpp"

namespace kreisel::bench {
namespace {

using nlohmann::json;

/// What can be said of any mesh, solid or not. Lengths in the file's unit.
struct Surface {
  std::string format;
  std::size_t vertices = 0, triangles = 0;  ///< as read
  MeshReport report;                        ///< as read
  RepairReport repairs;
  TriangleMesh mesh;  ///< repaired
  std::vector<Shell> shells;
  std::vector<std::vector<std::uint32_t>> enclosing;
  std::vector<std::array<std::uint32_t, 2>> crossings;  ///< pairs of triangles
};

/// What can be said of a solid. Millimetres, grams, model coordinates.
struct Solid {
  Vec3 extent, centre;
  double volume = 0, mass = 0;
  Vec3 principal;        ///< moments of inertia about the centre of mass, g mm^2, ascending
  Eigen::Matrix3d axes;  ///< columns, in that order
  std::vector<std::pair<std::string_view, Verdict>> verdicts;
};

Surface look_at_surface(const BodySpec& spec) {
  Source source = load_source(spec);
  Surface s;
  s.format = source.format;
  TriangleMesh mesh = std::move(source.mesh);
  s.vertices = mesh.vertices.size();
  s.triangles = mesh.triangles.size();
  s.report = inspect(mesh);
  s.mesh = repaired(std::move(mesh), s.repairs);
  s.shells = shells(s.mesh);
  s.enclosing = enclosing_shells(s.mesh, s.shells);
  s.crossings = self_intersections(s.mesh);
  return s;
}

/// What each problem says of the solid as it is.
std::vector<std::pair<std::string_view, Verdict>> verdicts(const BodySpec& spec, const Body& body,
                                                           device::Device& device) {
  std::vector<std::pair<std::string_view, Verdict>> all;
  BodySpec upright = spec;
  upright.stands_upright = true;
  const Body standing = make_body(upright, device);
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
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  s.principal = solver.eigenvalues();
  s.axes = solver.eigenvectors();
  return s;
}

std::string text(const Vec3& v, const char* between = ", ") {
  return fmt::format("{:.6g}{}{:.6g}{}{:.6g}", v[0], between, v[1], between, v[2]);
}

void print_checks(const Surface& s) {
  const MeshReport& r = s.report;
  fmt::print("  file       {}: {} vertices, {} triangles\n", s.format, s.vertices, s.triangles);
  fmt::print("  edges      {} open, {} of more than two triangles, {} along which two run the same way\n",
             r.open.count, r.crowded.count, r.misoriented.count);
  fmt::print("  triangles  {} using a vertex twice, {} without area, {} repeated\n", r.repeated_count,
             r.flat_count, r.duplicate_count);
  fmt::print("  vertices   {} equal to another, {} unused, {} at which parts merely touch\n",
             r.equal_vertex_count, r.unused_vertex_count, r.pinched_vertex_count);
  if (s.repairs.lines.empty()) fmt::print("  repairs    none\n");
  for (const std::string& line : s.repairs.lines) fmt::print("  repaired   {}\n", line);
  fmt::print("  crossings  {} pairs of triangles run through each other{}\n", s.crossings.size(),
             s.crossings.empty() ? ""
                                 : fmt::format(", the first {} and {}", s.crossings.front()[0] + 1,
                                               s.crossings.front()[1] + 1));
}

void print_shells(const Surface& s) {
  constexpr std::size_t most_lines = 20;
  fmt::print("  shells     {}\n", s.shells.size());
  for (std::size_t i = 0; i < s.shells.size() && i < most_lines; ++i) {
    const Shell& shell = s.shells[i];
    fmt::print("    {:<8} {} triangles, {}, Euler characteristic {}{}, volume {:.6g}{}\n", i + 1,
               shell.triangles.size(), shell.closed ? "closed" : "open", shell.euler,
               shell.genus ? fmt::format(", genus {}", *shell.genus) : "", shell.volume,
               s.enclosing[i].empty() ? "" : fmt::format(", inside {} other", s.enclosing[i].size()));
  }
  if (s.shells.size() > most_lines) fmt::print("    and {} more\n", s.shells.size() - most_lines);
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

json to_json(const Surface& s) {
  const MeshReport& r = s.report;
  json shells = json::array();
  for (std::size_t i = 0; i < s.shells.size(); ++i) {
    const Shell& shell = s.shells[i];
    shells.push_back({{"triangles", shell.triangles.size()},
                      {"closed", shell.closed},
                      {"euler", shell.euler},
                      {"genus", shell.genus ? json(*shell.genus) : json()},
                      {"volume", shell.volume},
                      {"depth", s.enclosing[i].size()}});
  }
  return {{"format", s.format},
          {"vertices", s.vertices},
          {"triangles", s.triangles},
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
            {"self_intersections", s.crossings.size()},
            {"first_self_intersection", s.crossings.empty() ? json() : json(s.crossings.front())}}},
          {"repairs", s.repairs.lines},
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
  const Surface surface = look_at_surface(spec);
  json summary = to_json(surface);
  summary["model"] = spec.model;
  if (!only_json) {
    fmt::print("{}\n", spec.model);
    print_checks(surface);
    print_shells(surface);
  }
  std::exception_ptr refusal;
  summary["solid"] = summary["error"] = nullptr;
  try {
    device::Device device(options.config.device);
    const Body body = make_body(spec, device);
    Solid solid = look_at_solid(body);
    solid.verdicts = verdicts(spec, body, device);
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

}  // namespace kreisel::bench
