#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/bench/commands.hpp"
#include "apps/shared/outputs.hpp"
#include "apps/shared/step_line.hpp"
#include "file/write_text.hpp"
#include "json_list.hpp"

namespace kreisel::core::bench {
namespace {

using nlohmann::json;

/// What is printed of one type, whatever its object and tool.
struct OfType {
  std::string type;
  bool of_part;
  double volume = 0;
  Moments mass = Moments::Zero();
};

std::vector<OfType> types_of(const Print& print) {
  std::vector<OfType> types;
  for (const PrintGroup& group : print.groups) {
    auto found = std::ranges::find_if(
        types, [&](const OfType& one) { return one.type == group.type && one.of_part == group.of_part; });
    if (found == types.end()) found = types.insert(types.end(), {group.type, group.of_part});
    found->volume += group.volume();
    found->mass += group.mass();
  }
  return types;
}

double volume_of_all(const Print& print) {
  return print.volume([](const PrintGroup&) { return true; });
}

std::string place(const Vec3& v) { return fmt::format("{:.4f}, {:.4f}, {:.4f}", v[0], v[1], v[2]); }

void print_body(const PrintedBody& body) {
  fmt::print("  volume     {:.6g} mm^3, mass {:.6g} g\n", body.volume, body.mass);
  fmt::print("  centre     {} mm of the bed\n", place(body.centre));
  for (int k = 0; k < 3; ++k)
    fmt::print("  principal  {:.6g} g mm^2 about {}\n", body.principal[k], place(body.axes.col(k)));
  for (const auto& [name, verdict] : body.verdicts)
    fmt::print("  {:<10} {}: {}\n", name, verdict.ok ? "yes" : "no", verdict.text);
}

void print_all(const Print& print) {
  fmt::print("  slicer     {}; {} lines, {} layers\n", print.slicer.empty() ? "not said" : print.slicer,
             print.lines, print.layers.size());
  for (std::size_t tool = 0; tool < print.filaments.size(); ++tool) {
    const Filament& f = print.filaments[tool];
    fmt::print("  filament   T{}: {:.4g} mm{}, {:.4g} g/cm^3{}\n", tool, f.diameter,
               f.diameter_assumed ? " (assumed: --filament says another)" : "", f.density,
               f.density_assumed ? " (assumed: --density says another)" : "");
  }
  for (const OfType& type : types_of(print))
    fmt::print("  {:<30} {:>12.2f} mm^3 {:>10.3f} g{}\n", type.type.empty() ? "without a type" : type.type,
               type.volume, type.mass[S1], type.of_part ? "" : "   not the part");
  fmt::print("  {:<30} {:>12.2f} mm^3", "all", volume_of_all(print));
  if (print.used_mm) fmt::print("; its slicer says {:.2f} mm of filament", *print.used_mm);
  fmt::print("\n");
}

json to_json(const PrintedBody& body) {
  json j;
  j["volume_mm3"] = body.volume;
  j["mass_g"] = body.mass;
  j["centre_of_mass_mm"] = json_list(body.centre);
  j["inertia_g_mm2"] = json_rows(body.inertia);
  j["principal_moments_g_mm2"] = json_list(body.principal);
  j["principal_axes"] = json_rows(body.axes.transpose());
  j["verified"] = json::object();
  for (const auto& [name, verdict] : body.verdicts)
    j["verified"][name] = {{"ok", verdict.ok}, {"text", verdict.text}, {"values", verdict.values}};
  return j;
}

json to_json(const PrintInspection& seen) {
  const Print& print = seen.print;
  json j = to_json(seen.part);
  j["format"] = "G-code";
  j["slicer"] = print.slicer;
  j["lines"] = print.lines;
  j["moments"] = json_list(print.part_mass());
  j["volume_of_all_mm3"] = volume_of_all(print);
  j["filament_used_mm"] = print.used_mm ? json(*print.used_mm) : json();
  j["filaments"] = j["types"] = j["objects"] = j["layers"] = json::array();
  for (const Filament& f : print.filaments)
    j["filaments"].push_back({{"diameter_mm", f.diameter},
                              {"diameter_assumed", f.diameter_assumed},
                              {"density", f.density},
                              {"density_assumed", f.density_assumed}});
  for (const OfType& type : types_of(print))
    j["types"].push_back({{"type", type.type},
                          {"of_part", type.of_part},
                          {"volume_mm3", type.volume},
                          {"mass_g", type.mass[S1]},
                          {"centre_of_mass_mm", json_list(centre_of_mass(type.mass))}});
  for (const PrintedBody& object : seen.objects) {
    j["objects"].push_back(to_json(object));
    j["objects"].back()["label"] = object.label;
  }
  for (const PrintLayer& layer : print.layers)
    j["layers"].push_back({{"z_mm", layer.z},
                           {"volume_mm3", layer.volume},
                           {"mass_g", layer.mass[S1]},
                           {"centre_of_mass_mm", json_list(centre_of_mass(layer.mass))}});
  return j;
}

}  // namespace

int inspect_gcode(const InspectPrintOptions& options) {
  require_writable(options.json_file, "--json");
  const PrintInspection seen = [&] {
    const apps::StepLine line;
    return inspect_print(options.file, options.filament, options.question, line.control());
  }();
  json summary = to_json(seen);
  summary["model"] = options.file;
  const std::string written = summary.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
  if (options.json_file == "-") {
    fmt::print("{}", written);
    return done;
  }
  fmt::print("{}\n", options.file);
  print_all(seen.print);
  fmt::print("the part\n");
  print_body(seen.part);
  for (const PrintedBody& object : seen.objects) {
    fmt::print("object {}\n", object.label.empty() ? "without a label" : object.label);
    print_body(object);
  }
  if (!options.json_file.empty()) write_text(options.json_file, written);
  return done;
}

}  // namespace kreisel::core::bench
