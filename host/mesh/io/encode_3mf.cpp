#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "geometry/single_precision.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/io/threemf/package.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

/// What readers in single precision can still tell apart from their neighbours by a metre.
constexpr double largest_coordinate = 1e9;

constexpr const char* content_types = R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)";

constexpr const char* relations = R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)";

/// As the value of an attribute.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  return safe;
}

template <class... Arguments>
void add(std::string& text, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  stop_here();
  fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

/// Every number with the fewest digits that give back the same double, which of a coordinate is a float.
void add_object(std::string& resources, std::string& build, std::size_t id, const MeshObject& object,
                const std::string& file) {
  const TriangleMesh mesh = joined(object.parts, file);
  require_coordinates_within(largest_coordinate, "coordinates within 1e9 mm in a 3MF file", mesh, file);
  const Vec3 place = object.place.value_or(place_of(bounding_box(mesh)));
  add(resources, "  <object id=\"{}\" type=\"model\"", id);
  if (!object.name.empty()) add(resources, " name=\"{}\"", escaped(object.name));
  resources += ">\n   <mesh>\n    <vertices>\n";
  for (const Vec3& v : mesh.vertices) {
    const Vec3 at = in_single_precision(Vec3(v - place));
    add(resources, "     <vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", at.x(), at.y(), at.z());
  }
  resources += "    </vertices>\n    <triangles>\n";
  for (const auto& [a, b, c] : mesh.triangles)
    add(resources, "     <triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", a, b, c);
  resources += "    </triangles>\n   </mesh>\n  </object>\n";
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
  return threemf::pack({{"[Content_Types].xml", content_types},
                        {"_rels/.rels", relations},
                        {"3D/3dmodel.model", std::move(model)}});
}

}  // namespace kreisel::core
