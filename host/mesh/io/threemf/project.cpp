#include "mesh/io/threemf/project.hpp"

#include <fmt/format.h>

#include "error.hpp"
#include "geometry/moved.hpp"
#include "mesh/io/threemf/model.hpp"
#include "mesh/io/threemf/package.hpp"
#include "mesh/io/threemf/settings.hpp"
#include "mesh/io/threemf/writing.hpp"

namespace kreisel::core::threemf {
namespace {

/// Bambu Studio and what came from it read the settings of a file of their own kind alone.
constexpr const char* orca_head = R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" xmlns:BambuStudio="http://schemas.bambulab.com/package/2021">
 <metadata name="Application">BambuStudio-01.09.00.00</metadata>
 <metadata name="BambuStudio:3mfVersion">1</metadata>
)";

constexpr const char* prusa_head = R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" xmlns:slic3rpe="http://schemas.slic3r.org/3mf/2017/06">
 <metadata name="slic3rpe:Version3mf">1</metadata>
)";

/// Of the build: columns of the rotation, then where the place goes.
std::string transform_text(const Project& project) {
  const Eigen::Matrix3d R = project.to_bed.linear();
  const Vec3 t = project.to_bed * project.place;
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}", R(0, 0), R(1, 0), R(2, 0), R(0, 1), R(1, 1),
                     R(2, 1), R(0, 2), R(1, 2), R(2, 2), t[0], t[1], t[2]);
}

std::string prusa_model(const Project& project, const std::string& name) {
  std::vector<TriangleMesh> meshes;
  for (const Volume& volume : project.volumes) meshes.push_back(volume.mesh);
  std::string text = prusa_head;
  add(text, " <resources>\n  <object id=\"1\" type=\"model\" name=\"{}\">\n", escaped(project.name));
  add_mesh(text, joined(meshes, name), project.place, name);
  add(text, "  </object>\n </resources>\n <build>\n  <item objectid=\"1\" transform=\"{}\"/>\n",
      transform_text(project));
  return text + " </build>\n</model>\n";
}

std::string prusa_settings(const Project& project) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<config>\n";
  add(text, " <object id=\"1\" instances_count=\"1\">\n");
  add(text, "  <metadata type=\"object\" key=\"name\" value=\"{}\"/>\n", escaped(project.name));
  std::size_t first = 0;
  for (const Volume& volume : project.volumes) {
    const auto set = [&](std::string_view key, std::string_view value) {
      add(text, "   <metadata type=\"volume\" key=\"{}\" value=\"{}\"/>\n", key, escaped(value));
    };
    const std::size_t next = first + volume.mesh.triangles.size();
    add(text, "  <volume firstid=\"{}\" lastid=\"{}\">\n", first, next - 1);
    set("name", volume.name);
    if (volume.modifier) set("modifier", "1");
    set("volume_type", volume.modifier ? "ParameterModifier" : "ModelPart");
    for (const auto& [key, value] : volume.settings) set(key, value);
    text += "  </volume>\n";
    first = next;
  }
  return text + " </object>\n</config>\n";
}

/// Of the whole project, as PrusaSlicer keeps them at the end of its G-code, too.
std::string prusa_profile(const Settings& settings) {
  std::string text;
  for (const auto& [key, value] : settings) add(text, "; {} = {}\n", key, value);
  return text;
}

std::string orca_model(const Project& project, const std::string& name) {
  std::string text = orca_head, components;
  text += " <resources>\n";
  std::size_t id = 0;
  for (const Volume& volume : project.volumes) {
    add(text, "  <object id=\"{}\" type=\"model\">\n", ++id);
    add_mesh(text, volume.mesh, project.place, name);
    text += "  </object>\n";
    add(components, "    <component objectid=\"{}\" transform=\"1 0 0 0 1 0 0 0 1 0 0 0\"/>\n", id);
  }
  add(text, "  <object id=\"{}\" type=\"model\">\n   <components>\n{}   </components>\n  </object>\n", ++id,
      components);
  add(text, " </resources>\n <build>\n  <item objectid=\"{}\" transform=\"{}\" printable=\"1\"/>\n", id,
      transform_text(project));
  return text + " </build>\n</model>\n";
}

std::string orca_settings(const Project& project) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<config>\n";
  const std::size_t whole = project.volumes.size() + 1;
  const auto set = [&](std::string_view indent, std::string_view key, std::string_view value) {
    add(text, "{}<metadata key=\"{}\" value=\"{}\"/>\n", indent, key, escaped(value));
  };
  add(text, "  <object id=\"{}\">\n", whole);
  set("    ", "name", project.name);
  set("    ", "extruder", "1");
  std::size_t id = 0;
  for (const Volume& volume : project.volumes) {
    add(text, "    <part id=\"{}\" subtype=\"{}\">\n", ++id,
        volume.modifier ? "modifier_part" : "normal_part");
    set("      ", "name", volume.name);
    set("      ", "matrix", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
    for (const auto& [key, value] : volume.settings) set("      ", key, value);
    text += "    </part>\n";
  }
  text += "  </object>\n  <plate>\n";
  set("    ", "plater_id", "1");
  text += "    <model_instance>\n";
  set("      ", "object_id", std::to_string(whole));
  set("      ", "instance_id", "0");
  return text + "    </model_instance>\n  </plate>\n</config>\n";
}

/// Without any setting of a project they take the shape alone, and drop what is set of its parts. One that
/// changes nothing is enough.
constexpr const char* orca_project = R"({
 "version": "01.09.00.00",
 "name": "project_settings",
 "from": "project",
 "filament_diameter": ["1.75"]
}
)";

/// Those of the mesh's triangles that belong to it, with vertices of their own.
TriangleMesh range_of(const TriangleMesh& mesh, std::size_t first, std::size_t last) {
  std::vector<std::uint32_t> numbers;
  for (std::size_t t = first; t <= last; ++t) numbers.push_back(static_cast<std::uint32_t>(t));
  return part_of(mesh, numbers);
}

}  // namespace

std::string encode_project(const Project& project, Dialect dialect, const std::string& name) {
  std::vector<std::pair<std::string, std::string>> parts = {{"[Content_Types].xml", content_types},
                                                            {"_rels/.rels", relations}};
  if (dialect == Dialect::prusa) {
    parts.emplace_back("3D/3dmodel.model", prusa_model(project, name));
    parts.emplace_back("Metadata/Slic3r_PE_model.config", prusa_settings(project));
    if (!project.settings.empty())
      parts.emplace_back("Metadata/Slic3r_PE.config", prusa_profile(project.settings));
  } else {
    parts.emplace_back("3D/3dmodel.model", orca_model(project, name));
    parts.emplace_back("Metadata/model_settings.config", orca_settings(project));
    parts.emplace_back("Metadata/project_settings.config", orca_project);
  }
  return pack(parts);
}

std::vector<Volume> read_project(const MeshFile& file) {
  const Package package = unpack(file);
  const auto refuse = [&](const char* what) {
    return InputError(fmt::format("{}: 3MF: {}, expected one object to be built", file.name, what));
  };
  const auto part = package.find("3d/3dmodel.model");
  if (part == package.end()) throw refuse("no model");
  const Model model = read_model(part->second, file.name);
  const SlicerSettings settings = slicer_settings(package, file.name);
  if (model.items.size() != 1) throw refuse("several items");
  const Placed& item = model.items.front();
  const auto object = model.objects.find(item.object);
  if (object == model.objects.end()) throw refuse("an item of no object");
  std::vector<Volume> volumes;
  for (const Placed& component : object->second.components) {
    const auto one = model.objects.find(component.object);
    if (one == model.objects.end()) throw refuse("a component of no object");
    volumes.push_back({"", moved(one->second.mesh, item.transform * component.transform),
                       !settings.of_component(item.object, component.object).empty()});
  }
  const TriangleMesh& mesh = object->second.mesh;
  std::size_t next = 0;
  const auto take = [&](std::size_t last, bool modifier) {
    if (last < next || last >= mesh.triangles.size()) return;
    volumes.push_back({"", moved(range_of(mesh, next, last), item.transform), modifier});
    next = last + 1;
  };
  if (const auto ranges = settings.ranges.find(item.object); ranges != settings.ranges.end())
    for (const RoleRange& range : ranges->second) {
      if (range.first > next) take(range.first - 1, false);
      take(range.last, true);
    }
  if (next < mesh.triangles.size()) take(mesh.triangles.size() - 1, false);
  return volumes;
}

}  // namespace kreisel::core::threemf
