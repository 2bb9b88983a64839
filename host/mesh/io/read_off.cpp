// Not OpenMesh's OFF reader: release 9 narrows coordinates to float, repeats the last face when a file is cut
// off, misreads a comment ahead of the header and never returns from an empty file.
#include "mesh/io/read_off.hpp"

namespace kreisel::core {
namespace {

struct Counts {
  std::size_t vertices, faces;
};

/// "OFF" with any of the prefixes ST, C, N. 4OFF and nOFF have other coordinates and are refused.
bool is_header(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  return word == "OFF";
}

/// Header and counts may share a line; the header may be absent.
Counts read_counts(MeshLines& lines) {
  std::string_view line;
  const bool any = lines.next(line);
  std::string_view rest = line;
  const std::string_view first = any ? next_word(rest) : std::string_view{};
  const bool header = is_header(first);
  if (!header && !parse<std::size_t>(first))
    throw lines.error(fmt::format("begins with '{}', expected OFF, COFF, NOFF or STOFF", shown(first)));
  if (header) {
    line = rest;
    if (next_word(rest).empty()) lines.next(line);
  }
  rest = line;
  const std::string_view nv = next_word(rest), nf = next_word(rest);
  const auto vertices = parse<std::size_t>(nv), faces = parse<std::size_t>(nf);
  if (!vertices || !faces)
    throw lines.error(
        fmt::format("counts '{} {}', expected text OFF with 'vertices faces edges'", shown(nv), shown(nf)));
  return {*vertices, *faces};
}

std::string_view next_of(MeshLines& lines, std::string_view what, std::size_t have, std::size_t want) {
  std::string_view line;
  if (!lines.next(line)) throw lines.error(fmt::format("ends after {} {}, expected {}", have, what, want));
  return line;
}

void read_face(const MeshLines& lines, std::string_view line, TriangleMesh& mesh) {
  const std::string_view word = next_word(line);
  const auto size = parse<std::size_t>(word);
  if (!size || *size < 3)
    throw lines.error(fmt::format("face of '{}' corners, expected 3 or more", shown(word)));
  std::vector<std::uint32_t> corners;
  for (std::size_t k = 0; k < *size; ++k) {
    const std::string_view corner = next_word(line);
    const auto index = parse<std::uint32_t>(corner);
    if (!index || *index >= mesh.vertices.size())
      throw lines.error(fmt::format("vertex index '{}', expected 0 to {}", shown(corner),
                                    std::ptrdiff_t(mesh.vertices.size()) - 1));
    corners.push_back(*index);
  }
  add_fan(mesh, corners);
}

}  // namespace

TriangleMesh read_off(const MeshFile& file) {
  MeshLines lines(file);
  const Counts counts = read_counts(lines);
  TriangleMesh mesh;  // grows with what is there: the counts of a broken file are not to be trusted
  for (std::size_t i = 0; i < counts.vertices; ++i) {
    std::string_view line = next_of(lines, "vertices", i, counts.vertices);
    mesh.vertices.push_back(lines.point(line, i + 1));
  }
  for (std::size_t i = 0; i < counts.faces; ++i)
    read_face(lines, next_of(lines, "faces", i, counts.faces), mesh);
  return mesh;
}

}  // namespace kreisel::core
