// writing.hpp - what every 3MF package that is written has.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "geometry/single_precision.hpp"
#include "mesh/io/encode.hpp"
#include "stop.hpp"

namespace kreisel::core::threemf {

inline constexpr const char* content_types = R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)";

inline constexpr const char* relations = R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)";

/// As the value of an attribute.
[[nodiscard]] inline std::string escaped(std::string_view text) {
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

/// An element `mesh`, its coordinates about a place. Every number with the fewest digits that give back the
/// same double, which of a coordinate is a float.
/// @throws InputError  a coordinate that readers in single precision cannot tell from its neighbours by a
/// metre
inline void add_mesh(std::string& text, const TriangleMesh& mesh, const Vec3& place,
                     const std::string& file) {
  require_coordinates_within(1e9, "coordinates within 1e9 mm in a 3MF file", mesh, file);
  text += "   <mesh>\n    <vertices>\n";
  for (const Vec3& v : mesh.vertices) {
    const Vec3 at = in_single_precision(Vec3(v - place));
    add(text, "     <vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", at.x(), at.y(), at.z());
  }
  text += "    </vertices>\n    <triangles>\n";
  for (const auto& [a, b, c] : mesh.triangles)
    add(text, "     <triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", a, b, c);
  text += "    </triangles>\n   </mesh>\n";
}

}  // namespace kreisel::core::threemf
