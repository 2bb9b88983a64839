#include "run/inspection_json.hpp"

#include "json_list.hpp"

namespace kreisel::core {
namespace {

using kreisel::RestReport;
using kreisel::ShellReport;
using kreisel::SolidReport;
using nlohmann::json;

json to_json(const ShellReport& shell) {
  json j;
  j["triangles"] = shell.triangles;
  j["closed"] = shell.closed;
  j["euler"] = shell.euler;
  j["genus"] = shell.genus ? json(*shell.genus) : json();
  j["volume"] = shell.volume;
  j["depth"] = shell.depth;
  return j;
}

json to_json(const SolidReport& s) {
  json j;
  j["extent_mm"] = json_list(s.extent);
  j["volume_mm3"] = s.volume;
  j["mass_g"] = s.mass;
  j["pieces_g"] = s.pieces;
  j["centre_of_mass_mm"] = json_list(s.centre);
  j["principal_moments_g_mm2"] = json_list(s.principal);
  for (int k = 0; k < 3; ++k) j["principal_axes"].push_back(json_list(s.axes.col(k)));
  j["rests"] = json::array();
  for (const RestReport& rest : s.rests)
    j["rests"].push_back({{"up", json_list(rest.up)},
                          {"probability", rest.probability},
                          {"tilt_degrees", rest.tilt_degrees},
                          {"area_mm2", rest.area}});
  for (const auto& [name, verdict] : s.verdicts) {
    json& one = j["verified"][name];
    one["ok"] = verdict.ok;
    one["text"] = verdict.text;
    one["values"] = verdict.values;
  }
  return j;
}

}  // namespace

json json_of(const Inspection& seen) {
  json j;
  j["format"] = seen.format;
  j["vertices"] = seen.vertices;
  j["triangles"] = seen.triangles;
  j["checks"] = seen.checks;
  j["checks"]["first_self_intersection"] = seen.first_crossing ? json(*seen.first_crossing) : json();
  j["repairs"] = seen.repairs;
  j["shells"] = json::array();
  for (const ShellReport& shell : seen.shells) j["shells"].push_back(to_json(shell));
  j["solid"] = seen.solid ? to_json(*seen.solid) : json();
  j["error"] = seen.error.empty() ? json() : json(seen.error);
  return j;
}

}  // namespace kreisel::core
