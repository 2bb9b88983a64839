#include <fmt/format.h>
#include <fmt/ranges.h>

#include "record/common_groups.hpp"
#include "record/hdf5_file.hpp"
#include "record/nest_record.hpp"
#include "record/record.hpp"
#include "record/simulation_record.hpp"
#include "record/write_certificate.hpp"

namespace kreisel::core {
namespace {

using hdf5::Group;
using hdf5::Labels;

constexpr const char* body_moment_units = "M (s1), M L (sx sy sz), M L^2 (rest)";
constexpr const char* model_moment_units = "g (s1), g mm (sx sy sz), g mm^2 (rest)";

const std::vector<std::string> xyz = {"x", "y", "z"};

void write_moments(Group& group, const std::string& name, const Moments& s,
                   const char* units = body_moment_units) {
  group.write(name, {s.data(), moment_names.size()}, {moment_names.size()},
              {units, {moment_names.begin(), moment_names.end()}});
}

void write_seconds(Group& group, const std::string& name, const std::vector<Seconds>& rows) {
  std::vector<double> values;
  for (const Seconds& s : rows) values.insert(values.end(), {s.setup, s.kernels, s.solve, s.total});
  group.write(name, values, {rows.size(), 4}, {"s", {"setup", "kernels", "solve", "total"}});
}

void write_root(Group& root, const Asked& config, const std::string& model) {
  root.set("schema", "kreisel run");
  root.set("schema_version", record_schema_version);
  root.set("moments_order", fmt::format("{}", fmt::join(moment_names, " ")));
  root.set("model", model);
  root.set("problem", config.problem);
  root.set("formulation", config.formulation);
  root.set("solver", solver_of(config));
}

void write_body(Group group, const RunResult& r) {
  group.set("name", r.body_name);
  group.set("repairs", fmt::format("{}", fmt::join(r.repairs, "\n")));
  group.set("density", r.density);
  group.set("interior_density", r.interior_density);
  group.set("void_density", r.void_density);
  group.set("density_units", "g/cm^3");
  group.set("solid_mass", r.solid_mass_grams);
  group.set("solid_mass_units", "g");
  group.set("length", r.length_mm);
  group.set("length_units", "mm");
  group.set("mass_unit", r.mass_unit_grams);
  group.set("mass_unit_units", "g");
  group.set("solid_objective", r.solid_objective);
  write_vector(group, "axis", r.axis, "1");
  write_vector(group, "contact", r.contact, "mm");
  write_vector(group, "frame_origin", r.frame.origin, "mm");
  // Eigen keeps columns, the file rows.
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = r.frame.rotation;
  group.write("frame_rotation", {rotation.data(), 9}, {3, 3}, {"1", xyz});
  write_moments(group, "solid", r.solid);
  write_moments(group, "fixed", r.fixed);
  write_moments(group, "interior", r.interior);
}

void write_domain(Group group, const RunResult& r) {
  group.set("kind", r.domain);
  group.set("wall", r.wall);
  group.set("wall_units", "L");
  group.set("spacing", r.grid.h);
  group.set("spacing_units", "L");
  group.set("rays", r.rays);
  group.set("inside_voxels", r.inside_voxels);
  group.set("interior_voxels", r.interior_voxels);
  group.write("grid", r.grid.n, {3}, {"cells", xyz});
  write_vector(group, "grid_origin", r.grid.origin, "L");
  if (r.domain == "exact") {
    std::vector<double> ends;
    for (const ExactInterval& run : r.exact_intervals)
      ends.insert(ends.end(), {double(run.ix), double(run.iy), run.z0, run.z1});
    group.write("intervals", ends, {r.exact_intervals.size(), 4}, {"cells, L", {"ix", "iy", "z0", "z1"}});
    return;
  }
  std::vector<int> rows;
  rows.reserve(4 * r.intervals.size());
  for (const Interval& run : r.intervals) rows.insert(rows.end(), {run.ix, run.iy, run.k0, run.k1});
  group.write("intervals", rows, {r.intervals.size(), 4}, {"cells", {"ix", "iy", "k0", "k1"}});
}

void write_history(Group& group, const std::vector<Iterate>& history) {
  std::vector<double> values;
  values.reserve(7 * history.size());
  for (const Iterate& i : history)
    values.insert(values.end(), {double(i.iteration), i.objective, i.violation, i.dual_infeasibility,
                                 i.barrier, i.regularization, double(i.line_search_trials)});
  group.write("history", values, {history.size(), 7},
              {"1",
               {"iteration", "objective", "violation", "dual_infeasibility", "barrier", "regularization",
                "line_search_trials"}});
}

void write_refinements(Group& group, const std::vector<Refinement>& rounds) {
  std::vector<double> values;
  for (const Refinement& r : rounds)
    values.insert(values.end(), {double(r.variables), double(r.cells.fractional), double(r.cells.coarse),
                                 double(r.cells.finest), double(r.cells.along), r.cells.weight, r.objective,
                                 r.regulariser, r.violation, double(r.iterations), r.seconds});
  group.write("refinements", values, {rounds.size(), 11},
              {"1; s (seconds)",
               {"variables", "fractional", "to_split", "finest", "along_voids", "weight", "objective",
                "regulariser", "violation", "iterations", "seconds"}});
}

void write_cells(Group& group, const std::vector<Cube>& cells) {
  std::vector<int> rows;
  rows.reserve(4 * cells.size());
  for (const Cube& c : cells) rows.insert(rows.end(), {c.x, c.y, c.z, c.edge});
  group.write("cells", rows, {cells.size(), 4}, {"cells", {"ix", "iy", "iz", "edge"}});
}

/// What one unit of x is, in words and as a length: the ray-rep may count in cells.
void write_variables(Group& group, const RunResult& r) {
  const bool heights = r.config.formulation == "rayrep";
  const auto settings = settings_of(r.config, "formulation");
  const auto unit = settings.find("unit");
  const bool cells = unit == settings.end() || unit->second == "cell";
  const char* units = !heights ? "1" : cells ? "h, from the body origin" : "L, from the body origin";
  group.write("x", r.outcome.x, {r.outcome.x.size()}, {units, {}});
  group.set("x_unit_length", !heights ? 0.0 : cells ? r.grid.h : 1.0);
}

void write_solve(Group group, const RunResult& r) {
  const Outcome& o = r.outcome;
  group.set("message", o.message);
  group.set("scope", r.scope);
  group.set("infeasibility", r.infeasibility);
  group.set("remedies", r.remedies);
  group.set("steps", o.steps);
  group.set("dual_infeasibility", o.dual_infeasibility);
  group.set("complementarity", o.complementarity);
  if (o.local_minimum) {
    group.set("strict_local_minimum", to_string(o.local_minimum->strict));
    group.set("smallest_eigenvalue", o.local_minimum->smallest);
    group.set("tangent_dimension", o.local_minimum->dimension);
  }
  group.set("kernel_seconds", o.kernel_seconds);
  group.set("solve_seconds", o.solve_seconds);
  group.set("evaluations_objective", o.evaluations.objective);
  group.set("evaluations_gradient", o.evaluations.gradient);
  group.set("evaluations_constraints", o.evaluations.constraints);
  group.set("evaluations_jacobian", o.evaluations.jacobian);
  group.set("evaluations_hessian", o.evaluations.hessian);
  group.set("repeat", r.config.repeat);
  group.set("budget", r.config.budget_seconds);
  group.set("budget_units", "s");
  for (const auto& [name, value] : o.settings) group.set("setting_" + name, value);
  for (const auto& [name, value] : r.formulation_settings) group.set("formulation_" + name, value);
  write_variables(group, r);
  if (!o.auxiliary.empty()) {  // those of principal_angle.hpp, the only problem with variables of its own
    group.set("phi", o.auxiliary.front());
    group.set("phi_units", "rad");
  }
  write_moments(group, "moments", o.moments);
  write_moments(group, "moments_model", r.model_moments(o.moments), model_moment_units);
  write_history(group, o.history);
  if (!o.refinements.empty()) {
    write_refinements(group, o.refinements);
    write_cells(group, r.cells);
  }
  write_seconds(group, "samples", r.samples);
  write_seconds(group, "median", {r.median});
}

void write_rounding(Group group, const RoundingCost& cost) {
  group.set("objective", cost.objective);
  group.set("violation", cost.violation);
  group.set("solid_voxels", cost.solid_voxels);
  group.set("void_voxels", cost.void_voxels);
  group.set("mended_voxels", cost.mended_voxels);
  group.set("moved_voxels", cost.moved_voxels);
  write_moments(group, "moments", cost.moments);
}

void write_voids(Group group, const Voids& voids) {
  group.write("pieces", voids.pieces, {voids.pieces.size()}, {"mm^3", {}});
  group.write("islands", voids.islands, {voids.islands.size()}, {"mm^3", {}});
  std::vector<double> cuts;
  for (const Cut& c : voids.cuts)
    cuts.insert(cuts.end(), {c.normal[0], c.normal[1], c.normal[2], c.offset, double(c.opens)});
  group.write("cuts", cuts, {voids.cuts.size(), 5}, {"1, mm", {"nx", "ny", "nz", "offset", "opens"}});
}

void write_verified(Group group, const Verified& v, const Voids& voids) {
  group.set("ok", v.verdict.ok);
  group.set("text", v.verdict.text);
  group.set("file", v.file);
  group.set("rounding_mismatch", v.rounding_mismatch);
  group.set("triangles", v.triangles);
  group.set("void_triangles", v.void_triangles);
  group.set("voids", voids.pieces.size());
  group.set("islands", voids.islands.size());
  group.set("cuts", voids.cuts.size());
  write_moments(group, "moments", v.moments);
  Group materials = group.new_group("materials");
  for (const WrittenMaterial& m : v.materials) {
    Group material = materials.new_group(m.name);
    material.set("density", m.density);
    material.set("mass", m.grams);
    material.set("file", m.file.string());
    material.set("triangles", m.triangles);
  }
  Group values = group.new_group("values");  // apart: a problem chooses these names
  for (const auto& [name, value] : v.verdict.values) values.set(name, value);
}

template <class Write>
void write_whole(const std::filesystem::path& path, const Write& write) {
  hdf5::File file = hdf5::File::create(path);
  write(file);
  file.close();
}

}  // namespace

void write_record(const std::filesystem::path& path, const RunResult& r) {
  write_whole(path, [&](hdf5::File& file) {
    write_root(file, r.config, r.body_name);
    file.set("termination", to_string(r.outcome.termination));
    file.set("objective", r.outcome.objective);
    file.set("constraint_violation", r.outcome.violation);
    file.set("iterations", r.outcome.iterations);
    file.set("variables", r.variables);
    file.set("whole_seconds", r.whole_seconds);
    file.set("peak_bytes", r.peak_bytes);
    write_config(file.new_group("config"), describe(r.config));
    write_provenance(file.new_group("provenance"), r.provenance);
    write_body(file.new_group("body"), r);
    write_domain(file.new_group("domain"), r);
    write_solve(file.new_group("solve"), r);
    if (r.config.part == Part::none) {
      file.set("no_part", no_part);
    } else {
      write_rounding(file.new_group("rounding"), r.rounding);
      write_voids(file.new_group("voids"), r.voids);
      write_verified(file.new_group("verified"), r.verified, r.voids);
    }
    if (r.certificate) {
      file.set("bound", r.certificate->bound);
      file.set("gap", r.gap());
      write_certificate(file.new_group("certificate"), *r.certificate);
    }
  });
}

void write_failure(const std::filesystem::path& path, const Run& run, const Provenance& provenance,
                   const std::string& message) {
  if (const auto* nest = std::get_if<NestConfig>(&run))
    return write_nest_failure(path, *nest, provenance, message);
  if (const auto* simulation = std::get_if<SimulationRun>(&run))
    return write_simulation_failure(path, *simulation, provenance, message);
  write_whole(path, [&](hdf5::File& file) {
    write_root(file, *asked_of(run), model_text(*asked_of(run)));
    file.set("error", message);
    write_config(file.new_group("config"), describe(run));
    write_provenance(file.new_group("provenance"), provenance);
  });
}

}  // namespace kreisel::core
