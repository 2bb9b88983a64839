#include <utility>

#include "geometry/single_precision.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/io/threemf/package.hpp"
#include "mesh/io/threemf/writing.hpp"

namespace kreisel::core {
namespace {

void add_object(std::string& resources, std::string& build, std::size_t id, const MeshObject& object,
                const std::string& file) {
  using threemf::add;
  const TriangleMesh mesh = joined(object.parts, file);
  const Vec3 place = object.place.value_or(place_of(bounding_box(mesh)));
  add(resources, "  <object id=\"{}\" type=\"model\"", id);
  if (!object.name.empty()) add(resources, " name=\"{}\"", threemf::escaped(object.name));
  resources += ">\n";
  threemf::add_mesh(resources, mesh, place, file);
  resources += "  </object>\n";
  add(build, "  <item objectid=\"{}\"", id);
  if (!place.isZero(0))
    add(build, " transform=\"1 0 0 0 1 0 0 0 1 {} {} {}\"", place.x(), place.y(), place.z());
  build += "/>\n";
}

}  // namespace

std::string encode_3mf(const std::vector<TriangleMesh>& parts, const std::string& name) {
  return encode_3mf_objects({{"", parts, {}}}, name);
}

std::string encode_3mf_objects(const std::vector<MeshObject>& objects, const std::string& name) {
  std::string model = R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
 <resources>
)";
  std::string build;
  for (std::size_t i = 0; i < objects.size(); ++i) add_object(model, build, i + 1, objects[i], name);
  model += " </resources>\n <build>\n" + build + " </build>\n</model>\n";
  return threemf::pack({{"[Content_Types].xml", threemf::content_types},
                        {"_rels/.rels", threemf::relations},
                        {"3D/3dmodel.model", std::move(model)}});
}

}  // namespace kreisel::core
