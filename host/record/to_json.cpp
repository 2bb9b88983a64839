#include <nlohmann/json.hpp>

#include "json_list.hpp"
#include "parse.hpp"
#include "record/record.hpp"

namespace kreisel::core {
namespace {

using nlohmann::json;

json to_json(const Seconds& s) {
  return {{"setup", s.setup}, {"kernels", s.kernels}, {"solve", s.solve}, {"total", s.total}};
}

/// The problem's settings; those that say what f is as set, else their defaults.
json weights(const RunConfig& config) {
  json all = json::object();
  ProblemSettings settings = settings_of(config, "problem");
  const ProblemSettings& defaults = find_problem(config.problem).weights;
  settings.insert(defaults.begin(), defaults.end());
  for (const auto& [name, text] : settings) {
    if (const auto value = parse<double>(text))
      all[name] = *value;
    else
      all[name] = text;
  }
  return all;
}

json provenance(const Provenance& p) {
  return {{"version", p.version},
          {"compiler", p.compiler},
          {"build_type", p.build_type},
          {"host", p.host},
          {"processor", p.processor},
          {"system", p.system},
          {"threads", p.threads},
          {"platform", p.platform},
          {"driver", p.driver},
          {"device_version", p.device_version},
          {"device_fp64", p.device_fp64},
          {"single_precision", p.single_precision},
          {"ipopt_version", p.ipopt_version},
          {"linear_solver", p.linear_solver},
          {"blas", p.blas},
          {"started", p.started}};
}

json evaluations(const Evaluations& e) {
  return {{"objective", e.objective},
          {"gradient", e.gradient},
          {"constraints", e.constraints},
          {"jacobian", e.jacobian},
          {"hessian", e.hessian}};
}

json refinements(const std::vector<Refinement>& rounds) {
  json all = json::array();
  for (const Refinement& r : rounds)
    all.push_back({{"variables", r.variables},
                   {"fractional", r.cells.fractional},
                   {"to_split", r.cells.coarse},
                   {"finest", r.cells.finest},
                   {"along_voids", r.cells.along},
                   {"weight", r.cells.weight},
                   {"objective", r.objective},
                   {"regulariser", r.regulariser},
                   {"constraint_violation", r.violation},
                   {"iterations", r.iterations},
                   {"seconds", r.seconds}});
  return all;
}

json local_minimum(const LocalMinimum& m) {
  return {{"strict", to_string(m.strict)},
          {"smallest_eigenvalue", m.smallest},
          {"dimension", m.dimension},
          {"text", m.text()}};
}

json rounding(const RoundingCost& cost) {
  return {{"objective", cost.objective},         {"constraint_violation", cost.violation},
          {"solid_voxels", cost.solid_voxels},   {"void_voxels", cost.void_voxels},
          {"mended_voxels", cost.mended_voxels}, {"moved_voxels", cost.moved_voxels}};
}

json cuts(const Voids& voids) {
  json all = json::array();
  for (const Cut& c : voids.cuts)
    all.push_back({{"normal", json_list(c.normal)}, {"offset", c.offset}, {"opens", c.opens}});
  return all;
}

/// The problem's own values stand beside ours; ours win should the names ever meet.
json verified(const Verified& v) {
  json all = json::object();
  for (const auto& [name, value] : v.verdict.values) all[name] = value;
  all["ok"] = v.verdict.ok;
  all["text"] = v.verdict.text;
  all["file"] = v.file;
  all["moments_body"] = json_list(v.moments);
  all["rounding_mismatch"] = v.rounding_mismatch;
  all["triangles"] = v.triangles;
  all["void_triangles"] = v.void_triangles;
  all["materials"] = json::array();
  for (const WrittenMaterial& m : v.materials)
    all["materials"].push_back({{"name", m.name},
                                {"density", m.density},
                                {"mass_g", m.grams},
                                {"file", m.file.string()},
                                {"triangles", m.triangles}});
  return all;
}

json frame(const RunResult& r) {
  return {{"origin", json_list(r.frame.origin)},
          {"rotation", json_rows(r.frame.rotation)},
          {"length", r.length_mm},
          {"mass", r.mass_unit_grams},
          {"axis", json_list(r.axis)},
          {"contact", json_list(r.contact)}};
}

/// NaN and infinity become null, bytes that are no UTF-8 the replacement character: what dump() writes, read
/// back, so that whoever dumps the answer need not think of either.
json plain(const json& value) {
  return json::parse(value.dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace

namespace {

json solved(const RunResult& r) {
  const Outcome& o = r.outcome;
  json samples = json::array();
  for (const Seconds& s : r.samples) samples.push_back(to_json(s));
  return {
      {"model", r.body_name},
      {"repairs", r.repairs},
      {"problem", r.config.problem},
      {"formulation", r.config.formulation},
      {"solver", solver_of(r.config)},
      {"grid", r.grid.n},
      {"variables", r.variables},
      {"iterations", o.iterations},
      {"termination", to_string(o.termination)},
      {"message", o.message},
      {"scope", r.scope},
      {"infeasibility", r.infeasibility},
      {"remedies", r.remedies},
      {"steps", o.steps},
      {"solver_settings", o.settings},
      {"formulation_settings", r.formulation_settings},
      {"refinements", refinements(o.refinements)},
      {"objective", o.objective},
      {"solid_objective", r.solid_objective},
      {"constraint_violation", o.violation},
      {"dual_infeasibility", o.dual_infeasibility},
      {"complementarity", o.complementarity},
      {"local_minimum", o.local_minimum ? local_minimum(*o.local_minimum) : json()},
      {"moments", json_list(r.model_moments(r.config.part != Part::none ? r.rounding.moments : o.moments))},
      {"moments_optimum", json_list(r.model_moments(o.moments))},
      {"moments_order", moment_names},
      {"moments_frame",
       {{"origin", {0.0, 0.0, 0.0}},
        {"axes", json_rows(Eigen::Matrix3d::Identity())},
        {"mass_unit", "g"},
        {"length_unit", "mm"}}},
      {"moments_body", json_list(o.moments)},
      {"seconds", to_json(r.median)},
      {"samples", samples},
      {"whole_seconds", r.whole_seconds},
      {"peak_bytes", r.peak_bytes},
  };
}

json posed(const RunResult& r) {
  return {
      {"domain", r.domain},
      {"rays", r.rays},
      {"inside_voxels", r.inside_voxels},
      {"interior_voxels", r.interior_voxels},
      {"frame", frame(r)},
      {"weights", weights(r.config)},
      {"wall", r.wall * r.length_mm},
      {"wall_setting", to_string(r.config.wall)},
      {"density", r.density},
      {"interior_density", r.interior_density},
      {"void_density", r.void_density},
      {"solid_mass_g", r.solid_mass_grams},
  };
}

json made(const RunResult& r) {
  const bool part = r.config.part != Part::none;
  return {
      {"bound", r.certificate ? json(r.certificate->bound) : json()},
      {"gap", r.certificate ? json(r.gap()) : json()},
      {"certificate", r.certificate ? json(to_string(r.certificate->kind)) : json()},
      {"boxes", r.certificate ? json(r.certificate->boxes.size()) : json()},
      {"certify_seconds", r.certificate ? json(r.certificate->seconds) : json()},
      {"rounding", part ? rounding(r.rounding) : json()},
      {"voids", part ? json(r.voids.pieces) : json()},
      {"islands", part ? json(r.voids.islands) : json()},
      {"cuts", part ? cuts(r.voids) : json()},
      {"verified", part ? verified(r.verified) : json()},
      {"no_part", part ? json() : json(no_part)},
      {"evaluations", evaluations(r.outcome.evaluations)},
      {"config", describe(r.config)},
      {"device", r.provenance.device},
      {"commit", r.provenance.commit},
      {"provenance", provenance(r.provenance)},
  };
}

}  // namespace

json to_json(const RunResult& r) {
  json all = solved(r);
  all.update(posed(r));
  all.update(made(r));
  return plain(all);
}

}  // namespace kreisel::core
