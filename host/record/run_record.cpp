#include <fmt/format.h>
#include <fmt/ranges.h>

#include "parse.hpp"
#include "problem/problem.hpp"
#include "record/common_fields.hpp"
#include "record/record.hpp"
#include "record/run_arrays.hpp"
#include "record/schema.hpp"
#include "record/with_fields.hpp"

namespace kreisel::core {
namespace fields {

template <>
struct Names<Termination> {
  using T = Termination;
  static constexpr std::array all = {T::optimal, T::acceptable, T::infeasible, T::failed, T::interrupted};
};
template <>
struct Names<LocalMinimum::Answer> {
  static constexpr std::array all = {LocalMinimum::Answer::no, LocalMinimum::Answer::yes,
                                     LocalMinimum::Answer::undecided};
};
template <>
struct Names<Reached> {
  static constexpr Reached all[] = {Reached::nothing, Reached::constraints, Reached::all};
};
template <>
struct Names<Certificate::Kind> {
  using K = Certificate::Kind;
  static constexpr std::array all = {K::linear, K::ratio, K::spin, K::yoyo, K::top, K::infeasible};
};

}  // namespace fields

namespace {
namespace of_run {

using namespace fields;
using nlohmann::json;

constexpr const char* body_units = "M (s1), M L (sx sy sz), M L^2 (rest)";
constexpr const char* model_units = "g (s1), g mm (sx sy sz), g mm^2 (rest)";

/// The problem's settings; those that say what f is as set, else their defaults.
json weights(const RunConfig& config) {
  json all = json::object();
  SettingTexts settings = settings_of(config, "problem");
  for (const ProblemEntry& entry : problems())  // a record's may be another program's
    if (entry.name == config.problem) settings.merge(entry.usual_weights());
  for (const auto& [name, text] : settings) {
    if (const auto value = parse<double>(text))
      all[name] = *value;
    else
      all[name] = text;
  }
  return all;
}

constexpr auto seconds_columns = [](auto& column, auto& s) {
  column("setup", s.setup);
  column("kernels", s.kernels);
  column("solve", s.solve);
  column("total", s.total);
};

constexpr auto deform_columns = [](auto& column, auto& step) {
  column("missed", step.missed);
  column("largest", step.largest);
  column("cuts", step.cuts);
};

constexpr auto refinement_columns = [](auto& column, auto& r) {
  column("variables", r.variables);
  column("fractional", r.cells.fractional);
  column("to_split", r.cells.coarse);
  column("finest", r.cells.finest);
  column("along_voids", r.cells.along);
  column("weight", r.cells.weight);
  column("objective", r.objective);
  column("regulariser", r.regulariser);
  column("violation", r.violation, "constraint_violation");
  column("iterations", r.iterations);
  column("seconds", r.seconds);
};

constexpr auto cut_columns = [](auto& column, auto& cut) {
  column.matrix({"nx", "ny", "nz"}, cut.normal, "normal");
  column("offset", cut.offset);
  column("opens", cut.opens);
};

/// What was asked, by whom and where.
template <class F, class R>
void asked(F& f, R& r) {
  schema_fields(f, run_schema);
  f.stored("moments_order", fmt::format("{}", fmt::join(moment_names, " ")));
  f.value("model", "model", r.body_name);
  config_fields(f, r.config);
  f.value("problem", "problem", r.config.problem);
  f.value("formulation", "formulation", r.config.formulation);
  const std::string solver = solver_of(r.config);
  f.stored("solver", solver);
  f.given("solver", solver);
  provenance_fields(f, r.provenance);
}

template <class F, class R>
void body_fields(F& f, R& r) {
  f.stored("body/name", r.body_name);
  f.value("body/repairs", "repairs", r.repairs);
  f.value("body/density", "density", r.density, "g/cm^3");
  f.value("body/interior_density", "interior_density", r.interior_density);
  f.value("body/void_density", "void_density", r.void_density);
  f.value("body/solid_mass", "solid_mass_g", r.solid_mass_grams, "g");
  f.value("body/length", "frame.length", r.length_mm, "mm");
  f.value("body/mass_unit", "frame.mass", r.mass_unit_grams, "g");
  f.value("body/solid_objective", "solid_objective", r.solid_objective);
  f.value("body/axis", "frame.axis", r.axis, "1");
  f.value("body/contact", "frame.contact", r.contact, "mm");
  f.value("body/frame_origin", "frame.origin", r.frame.origin, "mm");
  f.value("body/frame_rotation", "frame.rotation", r.frame.rotation, "1");
  if constexpr (F::reading) r.frame.length = r.length_mm;
  f.value("body/solid", "solid_moments_body", r.solid, body_units);
  f.value("body/fixed", "", r.fixed, body_units);
  f.value("body/interior", "", r.interior, body_units);
}

template <class F, class R>
void domain_fields(F& f, R& r) {
  f.value("domain/kind", "domain", r.domain);
  f.value("domain/wall", "", r.wall, "L");
  f.given("wall", r.wall * r.length_mm);
  f.given("wall_setting", to_string(r.config.wall));
  f.value("domain/spacing", "", r.grid.h, "L");
  f.value("domain/rays", "rays", r.rays);
  f.value("domain/inside_voxels", "inside_voxels", r.inside_voxels);
  f.value("domain/interior_voxels", "interior_voxels", r.interior_voxels);
  f.value("domain/grid", "grid", r.grid.n, "cells");
  f.value("domain/grid_origin", "", r.grid.origin, "L");
  f.bulk("domain", [&](hdf5::Group& group) { write_intervals(group, r); });
}

template <class F, class O>
void minimum_fields(F& f, O& o) {
  if (!f.part("solve/strict_local_minimum", "local_minimum", o.local_minimum.has_value())) return;
  auto& m = engaged<F>(o.local_minimum);
  f.value("solve/strict_local_minimum", "local_minimum.strict", m.strict);
  f.value("solve/smallest_eigenvalue", "local_minimum.smallest_eigenvalue", m.smallest);
  f.late("solve/tangent_dimension", "local_minimum.dimension", m.dimension);
  f.late("solve/why_undecided", "", m.why);
  f.given("local_minimum.text", m.text());
}

template <class F, class O>
void outcome_fields(F& f, O& o) {
  f.value("termination", "termination", o.termination);
  f.value("objective", "objective", o.objective);
  f.value("constraint_violation", "constraint_violation", o.violation);
  f.value("iterations", "iterations", o.iterations);
  f.value("solve/message", "message", o.message);
  f.late("solve/steps", "steps", o.steps);
  f.value("solve/dual_infeasibility", "dual_infeasibility", o.dual_infeasibility);
  f.value("solve/complementarity", "complementarity", o.complementarity);
  minimum_fields(f, o);
  f.value("solve/kernel_seconds", "", o.kernel_seconds);
  f.value("solve/solve_seconds", "", o.solve_seconds);
  f.value("solve/evaluations_objective", "evaluations.objective", o.evaluations.objective);
  f.value("solve/evaluations_gradient", "evaluations.gradient", o.evaluations.gradient);
  f.value("solve/evaluations_constraints", "evaluations.constraints", o.evaluations.constraints);
  f.value("solve/evaluations_jacobian", "evaluations.jacobian", o.evaluations.jacobian);
  f.value("solve/evaluations_hessian", "evaluations.hessian", o.evaluations.hessian);
  f.names("solve", "setting_", "solver_settings", o.settings);
  f.value("solve/moments", "moments_body", o.moments, body_units);
}

template <class F, class R>
void timing_fields(F& f, R& r) {
  f.value("solve/repeat", "repeat", r.config.repeat);
  f.value("solve/budget", "budget_seconds", r.config.budget_seconds, "s");
  f.rows("solve/samples", "samples", r.samples, "s", seconds_columns);
}

template <class F, class R>
void solve_fields(F& f, R& r) {
  outcome_fields(f, r.outcome);
  f.value("variables", "variables", r.variables);
  f.late("whole_seconds", "whole_seconds", r.whole_seconds);
  f.late("peak_bytes", "peak_bytes", r.peak_bytes);
  f.late("solve/scope", "scope", r.scope);
  f.late("solve/infeasibility", "infeasibility", r.infeasibility);
  f.late("solve/remedies", "remedies", r.remedies);
  timing_fields(f, r);
  f.names("solve", "formulation_", "formulation_settings", r.formulation_settings);
  f.bulk("solve", [&](hdf5::Group& group) { write_variables(group, r); });
  const Moments in_model = r.model_moments(r.outcome.moments);
  f.given("moments_optimum", json_of(in_model));
  f.given("moments_order", moment_names);
  f.given("moments_frame", json{{"origin", {0.0, 0.0, 0.0}},
                                {"axes", json_of(Eigen::Matrix3d::Identity().eval())},
                                {"mass_unit", "g"},
                                {"length_unit", "mm"}});
  f.bulk("solve", [&](hdf5::Group& group) {
    write_moments(group, "moments_model", in_model, model_units);
    write_history(group, r.outcome.history);
  });
  if (f.part("solve/refinements", "", !r.outcome.refinements.empty()))
    f.rows("solve/refinements", "refinements", r.outcome.refinements, "1; s (seconds)", refinement_columns);
  else
    f.given("refinements", json::array());
  f.row("solve/median", "seconds", r.median, "s", seconds_columns);
}

template <class F, class R>
void verified_fields(F& f, R& r) {
  auto& v = r.verified;
  f.names("verified/values", "", "verified", v.verdict.values);  // apart: a problem chooses these names
  f.value("verified/ok", "verified.ok", v.verdict.ok);
  f.value("verified/text", "verified.text", v.verdict.text);
  f.value("verified/file", "verified.file", v.file);
  f.value("verified/rounding_mismatch", "verified.rounding_mismatch", v.rounding_mismatch);
  f.value("verified/triangles", "verified.triangles", v.triangles);
  f.value("verified/void_triangles", "verified.void_triangles", v.void_triangles);
  f.value("verified/moments", "verified.moments_body", v.moments, body_units);
  f.given("verified.materials", json::array());
  f.each("verified/materials", v.materials, &WrittenMaterial::name, [&](auto& m, std::size_t index) {
    const std::string file = "verified/materials/" + m.name, at = fmt::format("verified.materials.{}", index);
    f.given(at + ".name", m.name);
    f.value(file + "/density", at + ".density", m.density);
    f.value(file + "/mass", at + ".mass_g", m.grams);
    f.value(file + "/file", at + ".file", m.file);
    f.value(file + "/triangles", at + ".triangles", m.triangles);
  });
}

template <class F, class R>
void part_fields(F& f, R& r) {
  const bool made = r.config.part != Part::none;
  f.given("moments", json_of(r.model_moments(made ? r.rounding.moments : r.outcome.moments)));
  if (!made) {
    f.stored("no_part", std::string(no_part));
    f.given("no_part", no_part);
    for (const char* name : {"rounding", "voids", "islands", "cuts", "verified"}) f.given(name, json());
    return;
  }
  f.given("no_part", json());
  auto& cost = r.rounding;
  f.value("rounding/objective", "rounding.objective", cost.objective);
  f.value("rounding/violation", "rounding.constraint_violation", cost.violation);
  f.value("rounding/solid_voxels", "rounding.solid_voxels", cost.solid_voxels);
  f.value("rounding/void_voxels", "rounding.void_voxels", cost.void_voxels);
  f.value("rounding/mended_voxels", "rounding.mended_voxels", cost.mended_voxels);
  f.late("rounding/moved_voxels", "rounding.moved_voxels", cost.moved_voxels);
  f.value("rounding/moments", "", cost.moments, body_units);
  f.late("voids/pieces", "voids", r.voids.pieces, "mm^3");
  f.late("voids/islands", "islands", r.voids.islands, "mm^3");
  f.rows("voids/cuts", "cuts", r.voids.cuts, "1, mm", cut_columns);
  verified_fields(f, r);
  f.stored("verified/voids", r.voids.pieces.size());
  f.stored("verified/islands", r.voids.islands.size());
  f.stored("verified/cuts", r.voids.cuts.size());
}

template <class F, class R>
void deformation_fields(F& f, R& r) {
  if (!f.part("deformation/reached", "deformation", r.deformation.has_value())) return;
  auto& d = engaged<F>(r.deformation);
  f.value("deformation/reached", "deformation.reached", d.reached);
  f.value("deformation/largest", "deformation.largest_mm", d.largest_mm, "mm");
  f.value("deformation/largest_percent", "deformation.largest_percent", d.largest_percent);
  f.value("deformation/where", "deformation.where_mm", d.where, "mm");
  f.value("deformation/volume_before", "deformation.volume_before_mm3", d.volume_before, "mm^3");
  f.value("deformation/volume_after", "deformation.volume_after_mm3", d.volume_after, "mm^3");
  f.value("deformation/least_determinant", "deformation.least_determinant", d.least_determinant);
  f.value("deformation/missed", "deformation.missed", d.missed);
  f.value("deformation/too_far", "deformation.too_far", d.too_far);
  f.value("deformation/crossings", "deformation.crossings", d.crossings);
  f.value("deformation/split", "deformation.split_triangles", d.split);
  f.value("deformation/seconds", "deformation.seconds", d.seconds, "s");
  f.late("deformation/energy", "deformation.energy", d.energy);
  if (f.part("deformation/joint/objective", "deformation.joint", d.joint.has_value())) {
    auto& joint = engaged<F>(d.joint);
    f.value("deformation/joint/objective", "deformation.joint.objective", joint.objective);
    f.value("deformation/joint/violation", "deformation.joint.violation", joint.violation, "body units");
    f.value("deformation/joint/iterations", "deformation.joint.iterations", joint.iterations);
    f.value("deformation/joint/variables", "deformation.joint.variables", joint.variables);
  }
  f.rows("deformation/history", "deformation.steps", d.history, "body units", deform_columns);
  f.bulk("deformation", [&](hdf5::Group& group) { write_displacement(group, d); });
}

template <class F, class R>
void certificate_fields(F& f, R& r) {
  if (!f.part("certificate/kind", "certificate", r.certificate.has_value())) {
    for (const char* name : {"bound", "gap", "boxes", "certify_seconds", "certificate_searches"})
      f.given(name, json());
    return;
  }
  auto& c = engaged<F>(r.certificate);
  f.value("certificate/kind", "certificate", c.kind);
  f.value("certificate/bound", "bound", c.bound);
  f.value("certificate/best", "", c.best);
  f.value("certificate/reached", "", c.reached);
  f.value("certificate/message", "", c.message);
  f.value("certificate/seconds", "certify_seconds", c.seconds);
  f.value("certificate/searches", "certificate_searches", c.searches);
  std::size_t boxes = c.boxes.size();
  f.count("certificate/boxes", "boxes", boxes);
  if constexpr (F::reading) c.boxes.resize(boxes);
  f.stored("bound", c.bound);
  f.stored("gap", r.gap());
  f.given("gap", r.gap());
  f.bulk("certificate", [&](hdf5::Group& group) { write_proof(group, c); });
}

/// Everything that a record of a run, its JSON, and whatever reads either know, once.
template <class F, class R>
void describe(F& f, R& r) {
  asked(f, r);
  body_fields(f, r);
  domain_fields(f, r);
  f.given("weights", weights(r.config));
  solve_fields(f, r);
  part_fields(f, r);
  deformation_fields(f, r);
  certificate_fields(f, r);
}

}  // namespace of_run
}  // namespace

void write_record(const std::filesystem::path& path, const RunResult& result) {
  fields::write_with(path, [&](fields::ToHdf5& f) {
    of_run::describe(f, result);
    fields::keep_summary(f, to_json(result));
  });
}

RunResult read_run(const std::filesystem::path& path) {
  RunResult result;
  fields::read_with(path, run_schema, [&](fields::FromHdf5& f) { of_run::describe(f, result); });
  return result;
}

RunResult read_timing(const std::filesystem::path& path) {
  RunResult result;
  fields::read_with(path, run_schema, [&](fields::FromHdf5& f) { of_run::timing_fields(f, result); });
  return result;
}

nlohmann::json to_json(const RunResult& result) {
  return fields::json_with([&](fields::ToJson& f) { of_run::describe(f, result); });
}

}  // namespace kreisel::core
