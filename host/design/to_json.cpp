#include <cmath>
#include <nlohmann/json.hpp>

#include "design/design.hpp"
#include "design/figures_json.hpp"
#include "json_list.hpp"

namespace kreisel::core {
namespace {

using nlohmann::json;

json to_json(const WrittenMould& written) {
  const Mould& mould = written.mould;
  json files = json::array();
  for (const auto& file : written.files) files.push_back(file.string());
  return {{"of", written.of},
          {"density", written.density},
          {"files", files},
          {"normal", json_list(mould.parting.normal)},
          {"offset", mould.parting.offset},
          {"undercut_mm3", mould.parting.undercut},
          {"sprue_radius_mm", mould.sprue_radius},
          {"vent_radius_mm", mould.vent_radius},
          {"vents", mould.vents},
          {"casting_mm3", mould.casting},
          {"cavity_mm3", mould.cavity},
          {"metal_mm3", mould.metal}};
}

json to_json(const DeformationReport& d) {
  json history = json::array();
  for (const DeformStep& step : d.history)
    history.push_back({{"missed", json_number(step.missed)}, {"largest", step.largest}, {"cuts", step.cuts}});
  return {{"reached", to_string(d.reached)},
          {"text", d.text()},
          {"largest_mm", d.largest_mm},
          {"largest_percent", d.largest_percent},
          {"where_mm", json_list(d.where)},
          {"too_far", d.too_far},
          {"crossings", d.crossings},
          {"volume_before_mm3", d.volume_before},
          {"volume_after_mm3", d.volume_after},
          {"least_determinant", d.least_determinant},
          {"split_triangles", d.split},
          {"missed", json_number(d.missed)},
          {"steps", history},
          {"seconds", d.seconds}};
}

json to_json(const Residual& residual) {
  return {{"centre_of_mass_mm", json_number(residual.centre_of_mass_mm)},
          {"axis_degrees", json_number(residual.axis_degrees)},
          {"mass_g", json_number(residual.mass_g)}};
}

json to_json(const InfillUse& use) {
  json blocks = json::array();
  for (const InfillBlock& block : use.density.blocks)
    blocks.push_back({{"edge_mm", block.edge}, {"share", block.share}});
  return {{"percent", use.infill.percent},  {"pattern", use.infill.pattern}, {"share", use.share},
          {"bulk_share", use.density.bulk}, {"skin_mm", use.density.skin},   {"volume_mm3", use.volume},
          {"surface_mm2", use.surface},     {"slicer", use.density.slicer},  {"blocks", blocks}};
}

json to_json(const Supports& supports) {
  return {{"support_in_voids_mm3", supports.in_voids}, {"support_everywhere_mm3", supports.in_all}};
}

json to_json(const FoundUp& found) {
  json sliced = json::array();
  for (const UpTried& tried : found.sliced) {
    json one = to_json(tried.supports);
    one["up"] = json_list(tried.up);
    sliced.push_back(one);
  }
  return {{"up", json_list(found.up)}, {"directions", found.directions}, {"sliced", sliced}};
}

/// @return  3x4, from the G-code's coordinates to the model's
json motion_of(const Sliced& sliced) {
  json rows;
  const Eigen::Matrix<double, 3, 4> motion = sliced.bed_to_model.matrix().topRows<3>();
  for (int row = 0; row < 3; ++row) rows.push_back(json_list(motion.row(row).transpose()));
  return rows;
}

json to_json(const PrintedPart& printed, const std::vector<Residual>& rounds) {
  json j = json_of(printed.figures);
  j["constraint_residual"] = to_json(printed.residual);
  if (printed.pieces.size() == 1) j["bed_to_model"] = motion_of(printed.pieces.front().sliced);
  if (printed.pieces.size() > 1)
    for (const PrintedPiece& piece : printed.pieces)
      j["pieces"].push_back({{"name", piece.name},
                             {"bed_to_model", motion_of(piece.sliced)},
                             {"volume_mm3", piece.sliced.print.part_volume()}});
  j["slicer"] = printed.first().slicer;
  j["settings"] = printed.pieces.front().sliced.settings;
  j["beside_mm3"] = printed.beside();
  j["rounds"] = json::array();
  for (const Residual& round : rounds) j["rounds"].push_back(to_json(round));
  return j;
}

}  // namespace

std::string to_json(const Design& design) {
  const RunResult& r = design.run;
  json summary = {{"model", r.config.body.model},
                  {"problem", r.config.problem},
                  {"formulation", r.config.formulation},
                  {"config", design.config},
                  {"commit", r.provenance.commit},
                  {"device", r.provenance.device},
                  {"repairs", r.repairs},
                  {"termination", to_string(r.outcome.termination)},
                  {"ok", design.does()},
                  {"density", r.density},
                  {"axis", json_list(r.axis)},
                  {"contact", json_list(r.contact)},
                  {"wall_asked_mm", r.wall * r.length_mm},
                  {"before", json_of(design.before)},
                  {"files", json::array()},
                  {"seconds", r.whole_seconds},
                  {"peak_bytes", r.peak_bytes}};
  if (r.deformation) summary["deformation"] = to_json(*r.deformation);
  if (!design.pose.empty()) summary["pose"] = design.pose;
  if (!design.feasible() || !design.other_axes.empty()) summary["other_axes"] = design.other_axes;
  if (!design.feasible()) {
    summary["after"] = nullptr;
    summary["infeasibility"] = r.infeasibility;
    summary["remedies"] = r.remedies;
    return summary.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
  }
  json cuts = json::array();
  for (const Cut& cut : r.voids.cuts)
    cuts.push_back({{"normal", json_list(cut.normal)}, {"offset", cut.offset}, {"opens", cut.opens}});
  for (const auto& file : design.files) summary["files"].push_back(file.string());
  summary["after"] = json_of(design.after);
  summary["constraint_residual"] = to_json(design.residual);
  if (design.infill) summary["infill"] = to_json(*design.infill);
  if (design.printed) {
    json print = to_json(*design.printed, design.rounds);
    print["support_in_voids_mm3"] = json();
    if (design.infill) print["support_in_voids_mm3"] = 0;
    if (design.supports) print.update(to_json(*design.supports));
    if (design.found_up) print["found_up"] = to_json(*design.found_up);
    summary["print"] = print;
  }
  summary["survives"] = json();
  if (design.survives)
    summary["survives"] = {{"flow_and_density_percent",
                            {json_number(design.survives->least), json_number(design.survives->most)}}};
  if (design.weighed)
    summary["weighed"] = {{"measured_g", design.weighed->measured},
                          {"expected_g", design.weighed->expected},
                          {"density", design.weighed->density}};
  summary["wall_mm"] = json_number(design.wall);
  summary["thinnest_mm"] = json_number(design.thinnest.thickness);
  summary["thinnest_at_mm"] =
      std::isfinite(design.thinnest.thickness) ? json_list(design.thinnest.at) : json();
  summary["voids"] = r.voids.pieces;
  summary["islands"] = r.voids.islands;
  summary["cuts"] = cuts;
  summary["cut_by"] = json::array();
  for (const Plane& cut : design.cuts)
    summary["cut_by"].push_back({{"normal", json_list(cut.normal)}, {"offset", cut.offset}});
  summary["pieces_mm3"] = design.pieces;
  summary["moved_mm"] =
      json_list(r.verified.materials.empty() ? Vec3(Vec3::Zero()) : r.verified.materials.front().moved);
  summary["triangles"] = r.verified.triangles;
  summary["cavity_triangles"] = r.verified.void_triangles;
  summary["moulds"] = json::array();
  for (const WrittenMould& mould : design.moulds) summary["moulds"].push_back(to_json(mould));
  summary["drains"] = json::array();
  for (const Drain& drain : design.drains)
    summary["drains"].push_back({{"from", json_list(drain.from)}, {"along", json_list(drain.along)}});
  return summary.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace kreisel::core
