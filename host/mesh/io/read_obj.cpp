// Connectivity by OpenMesh, coordinates by us: OpenMesh 9 narrows them to float and drops vertices it cannot
// read. It gets only the vertex and face lines, so it neither looks for material files nor warns about them.
#include "mesh/io/read_obj.hpp"

#include <OpenMesh/Core/IO/Options.hh>
#include <OpenMesh/Core/IO/reader/OBJReader.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <sstream>

#include "mesh/io/polygon_collector.hpp"

namespace kreisel::core {
namespace {

/// OpenMesh writes to stderr through a stream of its own; closed while this lives.
class QuietOpenMesh {
 public:
  QuietOpenMesh() : was_on_(omerr().is_enabled()) { omerr().disable(); }
  ~QuietOpenMesh() {
    if (was_on_) omerr().enable();
  }
  QuietOpenMesh(const QuietOpenMesh&) = delete;
  QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;

 private:
  bool was_on_;
};

/// A backslash at the end of a line continues it on the next.
MeshFile joined(const MeshFile& file) {
  MeshFile out = file;
  std::string& s = out.bytes;
  for (std::size_t at = s.find('\\'); at != std::string::npos; at = s.find('\\', at + 1)) {
    const std::size_t end = s.find_first_not_of(" \t\r", at + 1);
    if (end != std::string::npos && s[end] == '\n') s.replace(at, end + 1 - at, 1, ' ');
  }
  return out;
}

/// What OpenMesh is to see, and the coordinates it is not.
struct Scan {
  std::vector<Vec3> vertices;
  std::string connectivity;
  std::size_t faces = 0;
};

Scan scan(const MeshFile& file) {
  Scan out;
  MeshLines lines(file);
  for (std::string_view line; lines.next(line);) {
    const std::string_view keyword = next_word(line);
    if (keyword == "v") {
      out.vertices.push_back(lines.point(line, out.vertices.size() + 1));
      out.connectivity += "v 0 0 0\n";  // keeps its place: negative indices count back from here
    } else if (keyword == "f") {
      out.connectivity += 'f';
      std::size_t corners = 0;
      for (std::string_view word; !(word = next_word(line)).empty(); ++corners) {
        const std::string_view index = word.substr(0, word.find('/'));  // then texture and normal, not used
        const auto value = parse<std::int32_t>(index);
        if (!value || *value == 0)
          throw lines.error(
              fmt::format("vertex index '{}', expected a whole number, 1 or more", shown(word)));
        (out.connectivity += ' ') += index;
      }
      if (corners < 3) throw lines.error(fmt::format("face of {} corners, expected 3 or more", corners));
      out.connectivity += '\n';
      ++out.faces;
    }
  }
  return out;
}

PolygonCollector connect(const Scan& scanned) {
  const QuietOpenMesh quiet;
  PolygonCollector collector;
  std::istringstream in(scanned.connectivity);
  OpenMesh::IO::Options options;
  OpenMesh::IO::OBJReader().read(in, collector, options);
  return collector;
}

}  // namespace

TriangleMesh read_obj(const MeshFile& file) {
  Scan scanned = scan(joined(file));
  const PolygonCollector collector = connect(scanned);
  if (collector.polygons().size() != scanned.faces)
    throw InputError(
        fmt::format("{}: {} of {} faces could be read, expected 3 or more different corners each", file.name,
                    collector.polygons().size(), scanned.faces));
  TriangleMesh mesh;
  mesh.vertices = std::move(scanned.vertices);
  for (std::size_t f = 0; f < scanned.faces; ++f) {
    std::vector<std::uint32_t> corners;
    for (const OpenMesh::VertexHandle v : collector.polygons()[f]) {
      if (v.idx() < 0 || std::size_t(v.idx()) >= mesh.vertices.size())
        throw InputError(fmt::format("{}: face {} has vertex index {}, expected 1 to {}", file.name, f + 1,
                                     v.idx() + 1, mesh.vertices.size()));
      corners.push_back(std::uint32_t(v.idx()));
    }
    add_fan(mesh, corners);
  }
  return mesh;
}

}  // namespace kreisel::core
