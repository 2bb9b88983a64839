#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/bench/commands.hpp"
#include "apps/shared/outputs.hpp"
#include "apps/shared/step_line.hpp"
#include "fabricate/wall.hpp"
#include "fabricate/write_halves.hpp"
#include "mesh/io/format.hpp"
#include "record/record.hpp"
#include "session/pipeline.hpp"

namespace kreisel::core::bench {
namespace {

void print_certificate(const RunResult& r) {
  const Certificate& c = *r.certificate;
  if (c.kind == Certificate::Kind::infeasible) {
    fmt::print(
        "  certified  no interior meets the constraints: a quadric separates them by {:.3g}; {:.2f} s\n",
        c.separation, c.seconds);
    return;
  }
  const std::string gap = std::isfinite(r.gap()) ? fmt::format("gap {:.3g} %, ", 100 * r.gap()) : "";
  fmt::print("  certified  f >= {:.6f}, {}{} boxes, {:.2f} s ({})\n", c.bound, gap, c.boxes.size(), c.seconds,
             c.message);
  if (r.outcome.violation > 1e-6 && c.reached)
    fmt::print("  feasible   f = {:.6f} can be had, by --formulation quadric\n", c.best);
  else if (c.best < r.outcome.objective - 1e-6 * std::abs(r.outcome.objective))
    fmt::print("  better     f = {:.6f} was found on the way, by --formulation quadric\n", c.best);
}

/// What is of which density, where that takes more than one number.
void print_materials(const RunResult& r) {
  if (r.interior_density == r.density && r.void_density == 0) return;
  fmt::print("  materials  shell {:.4g}, interior {:.4g}, voids {:.4g} g/cm^3{}\n", r.density,
             r.interior_density, r.void_density,
             r.void_density > r.interior_density ? ": solid, below, is the voids' filling" : "");
}

void print_files(const Verified& v) {
  if (v.file.empty()) return;
  if (v.materials.size() == 1) {
    fmt::print("  written    {} ({} triangles, {} of them around voids)\n", v.file, v.triangles,
               v.void_triangles);
    return;
  }
  for (const WrittenMaterial& m : v.materials)
    fmt::print("  written    {}: {} of {:.4g} g/cm^3, {:.4g} g ({} triangles)\n", m.file.string(), m.name,
               m.density, m.grams, m.triangles);
}

void print_result(const RunResult& r, const TriangleMesh& outer) {
  const Outcome& o = r.outcome;
  const Vec3 size = bounding_box(outer).extent();
  fmt::print("{}: {} by {} with {} on {}{}\n", r.body_name, r.config.problem, r.config.formulation,
             solver_of(r.config), r.provenance.device,
             r.provenance.single_precision ? " (single precision, compensated)" : "");
  fmt::print(
      "  body       {:.4g} x {:.4g} x {:.4g} mm, {:.4g} g solid; axis {:.4g},{:.4g},{:.4g} through "
      "{:.2f},{:.2f},{:.2f}\n",
      size[0], size[1], size[2], r.solid_mass_grams, r.axis[0], r.axis[1], r.axis[2], r.contact[0],
      r.contact[1], r.contact[2]);
  for (const std::string& line : r.repairs) fmt::print("  repaired   {}\n", line);
  fmt::print("  domain     {} {} x {} x {} of {:.4g} mm, wall {} = {:.4g} mm: {} rays{}\n", r.domain,
             r.grid.n[0], r.grid.n[1], r.grid.n[2], r.grid.h * r.length_mm, to_string(r.config.wall),
             r.wall * r.length_mm, r.rays,
             r.domain == "exact" ? "" : fmt::format(", {} voxels", r.interior_voxels));
  if (!r.scope.empty()) fmt::print("  possible   {}\n", r.scope);
  fmt::print("  solve      {} ({}), {} iterations, {} variables\n", to_string(o.termination), o.message,
             o.iterations, r.variables);
  if (o.local_minimum) fmt::print("  minimum    strict local minimum: {}\n", o.local_minimum->text());
  for (const Refinement& round : o.refinements)
    fmt::print(
        "  refine     {:>7} cells, {:>6} fractional ({} to split), {:>6} finest, {} along voids; f = {:.6f}, "
        "regulariser {:.2g}; {} iterations, {:.2f} s\n",
        round.variables, round.cells.fractional, round.cells.coarse, round.cells.finest, round.cells.along,
        round.objective, round.regulariser, round.iterations, round.seconds);
  if (!r.infeasibility.empty()) fmt::print("  infeasible {}\n", r.infeasibility);
  if (!r.remedies.empty()) fmt::print("  would help {}\n", r.remedies);
  fmt::print("  time       {:.3f} s solve ({:.3f} s in kernels), {:.3f} s set-up; median of {}\n",
             r.median.solve, r.median.kernels, r.median.setup, r.samples.size());
  if (r.certificate) print_certificate(r);
  fmt::print("  objective  {:.6f} (the solid body: {:.6f}); violation {:.1e}\n", o.objective,
             r.solid_objective, o.violation);
  if (r.config.part == Part::none) {
    fmt::print("  part       {}\n", no_part);
    return;
  }
  if (r.domain == "exact")
    fmt::print("  meshed     {:.6f}; violation {:.1e}; a smooth cavity of {} triangles, {} correction{}\n",
               r.rounding.objective, r.rounding.violation, r.verified.void_triangles, r.rounding.corrections,
               r.rounding.corrections == 1 ? "" : "s");
  else
    fmt::print(
        "  rounded    {:.6f}; violation {:.1e}; {} of {} voxels void, {} filled to keep the surface a "
        "manifold, {} moved to meet the constraints\n",
        r.rounding.objective, r.rounding.violation, r.rounding.void_voxels, r.interior_voxels,
        r.rounding.mended_voxels, r.rounding.moved_voxels);
  const Eigen::Vector3d c = centre_of_mass(r.rounding.moments) * r.length_mm;
  print_materials(r);
  fmt::print("  part       {:.4g} g, centre of mass {:.3f},{:.3f},{:.3f} mm in the body frame\n",
             r.rounding.moments[S1] * r.mass_unit_grams, c[0], c[1], c[2]);
  if (!r.voids.pieces.empty()) fmt::print("  voids      {}\n", r.voids.text());
  fmt::print("  whole      {:.1f} s from the model to the verified part, {:.2g} GiB\n", r.whole_seconds,
             r.peak_bytes / (1 << 30));
  fmt::print("  verified   {}\n", r.verified.verdict.text);
  print_files(r.verified);
}

/// Columns keep up to half a cell less than is asked for, the exact domain nothing.
void print_wall(const RunOutput& output) {
  const double wall = least_wall(output.outer, output.cavity);
  const RunResult& r = output.result;
  if (std::isfinite(wall))
    fmt::print("  wall       {:.4f} mm at the thinnest, asked for {:.4f}\n", wall, r.wall * r.length_mm);
}

RunOutput run_showing_steps(const OnceOptions& options) {
  const StepLine line;
  return run(options.config, options.mesh_file, line.control());
}

}  // namespace

int run_once(const OnceOptions& options) {
  require_writable(options.json_file, "--json");
  require_writable(options.mesh_file, "--mesh");
  require_replaceable(options.mesh_file, "--mesh");
  if (!options.mesh_file.empty()) (void)mesh_format(options.mesh_file);
  require_writable(options.record_file, "--record");
  const RunOutput output = run_showing_steps(options);
  const RunResult& result = output.result;
  std::vector<std::filesystem::path> halves;
  if (const auto axle = axle_of(options.config.body.axle); axle && !options.mesh_file.empty())
    halves = write_halves(options.mesh_file, {output.outer, output.cavity}, result.frame, *axle);
  if (!options.record_file.empty()) write_record(options.record_file, result);
  const std::string json = to_json(result).dump(2) + "\n";
  if (options.json_file == "-") {
    fmt::print("{}", json);  // alone on standard output, for a pipe
  } else {
    if (!options.json_file.empty()) write_text(options.json_file, json);
    print_result(result, output.outer);
    print_wall(output);
    for (const std::filesystem::path& file : halves) fmt::print("  part       {}\n", file.string());
  }
  const bool cut_short = result.samples.size() < static_cast<std::size_t>(options.config.repeat);
  return cut_short && interruption().stop_requested() ? was_interrupted
                                                      : exit_code(result.outcome.termination);
}

}  // namespace kreisel::core::bench
