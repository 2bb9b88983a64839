// threemf_package.hpp - 3MF packages written by hand.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "mesh/zip_file.hpp"

namespace kreisel::core::threemf_package {

inline const std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>";
using Files = std::vector<std::pair<std::string, std::string>>;

/// A text of a model around the content of <model>.
inline std::string model(const std::string& content, const std::string& attributes = "unit=\"millimeter\"") {
  return xml +
         "<model xml:lang=\"en-US\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" " +
         attributes + ">" + content + "</model>";
}

/// A package around the content of <model>. @param more  files beside it
inline std::string package(const std::string& content, const std::string& attributes = "unit=\"millimeter\"",
                           const Files& more = {}) {
  Files files = {
      {"[Content_Types].xml",
       xml + "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\"><Default "
             "Extension=\"rels\" "
             "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Default "
             "Extension=\"model\" "
             "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>"},
      {"_rels/.rels",
       xml + "<Relationships "
             "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship "
             "Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
             "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
      {"3D/3dmodel.model", model(content, attributes)}};
  files.insert(files.end(), more.begin(), more.end());
  return zip_file(files);
}

/// A tetrahedron with legs 1, 2, 3: of volume 1. @param in_object  goes ahead of its mesh
inline std::string object(int id, const std::string& type = "model",
                          const std::string& last_triangle = "2 0 3", const std::string& last_x = "0",
                          const std::string& in_object = "") {
  const std::string& t = last_triangle;
  return "<object id=\"" + std::to_string(id) + "\" type=\"" + type + "\">" + in_object +
         "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
         "<vertex x=\"0\" y=\"2\" z=\"0\"/><vertex x=\"" +
         last_x +
         "\" y=\"0\" z=\"3\"/></vertices><triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\"/>"
         "<triangle v1=\"0\" v2=\"1\" v3=\"3\"/><triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"" +
         t[0] + "\" v2=\"" + t[2] + "\" v3=\"" + t[4] + "\"/></triangles></mesh></object>";
}

inline std::string resources(const std::string& objects) { return "<resources>" + objects + "</resources>"; }
inline std::string build(const std::string& items) { return "<build>" + items + "</build>"; }
inline const std::string item = "<item objectid=\"1\"/>";
inline const std::vector<Triangle> tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

}  // namespace kreisel::core::threemf_package
