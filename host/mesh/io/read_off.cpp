#include "mesh/io/read_off.hpp"

#include <fmt/format.h>

#include "mesh/io/polygons.hpp"
#include "mesh/io/text.hpp"
#include "parse.hpp"

namespace kreisel::core {
namespace {

struct Layout {
  std::size_t vertices = 0, faces = 0;
  std::size_t attributes = 0;  ///< numbers behind the coordinates of a vertex
  bool in_lines = true;        ///< every vertex and face in a line of its own, with anything behind it
};

/// What stands ahead of "OFF" in the header: ST, C and N in any order. Others have other coordinates.
void read_prefix(std::string_view prefix, const Words& words, Layout& layout) {
  const std::string_view all = prefix;
  while (!prefix.empty()) {
    if (prefix.starts_with("ST")) {
      layout.attributes += 2;
      prefix.remove_prefix(1);
    } else if (prefix.starts_with('N')) {
      layout.attributes += 3;
    } else if (prefix.starts_with('C')) {
      layout.attributes += 4;
    } else {
      const bool dimensions = all.find_first_not_of("4nSTCN") == std::string_view::npos;
      throw words.error(fmt::format("begins with '{}OFF', {}expected OFF, COFF, NOFF or STOFF", shown(all),
                                    dimensions ? "which has other than three coordinates a vertex; " : ""));
    }
    prefix.remove_prefix(1);
  }
}

/// Reads the header, which may be absent, and what is glued to it. @return  the word behind it
std::string_view read_header(Words& words, Layout& layout) {
  const std::string_view first = words.next();
  if (parse<std::size_t>(first)) return first;
  const std::size_t at = lower_case(first).find("off");
  if (at == std::string_view::npos ||
      first.substr(0, at).find_first_not_of("4nSTCNstc") != std::string_view::npos)
    throw words.error(fmt::format("begins with '{}', expected OFF, COFF, NOFF or STOFF", shown(first)));
  std::string prefix(first.substr(0, at));
  // In small letters all of them mean the same, but for the n of other dimensions.
  if (first.substr(at, 3) == "off")
    for (char& c : prefix)
      if (c >= 'a' && c <= 'z') c = char(c - 'a' + 'A');
  read_prefix(prefix, words, layout);
  const std::string_view glued = first.substr(at + 3);
  return glued.empty() ? words.next() : glued;
}

/// The word in the line of its own that the number of edges may have.
void skip_edges(Words& words) {
  if (!words.next_in_line().empty()) return;
  Words probe = words;
  if (probe.next().empty() || !probe.next_in_line().empty()) return;
  words = probe;
}

Layout read_counts(Words& words) {
  Layout layout;
  const std::string_view nv = read_header(words, layout), nf = words.next();
  const auto vertices = parse<std::size_t>(nv), faces = parse<std::size_t>(nf);
  if (!vertices || !faces)
    throw words.error(
        fmt::format("counts '{} {}', expected text OFF with 'vertices faces edges'", shown(nv), shown(nf)));
  layout.vertices = *vertices;
  layout.faces = *faces;
  skip_edges(words);
  return layout;
}

std::size_t count_lines(Words words) {
  std::size_t lines = 0;
  for (; !words.next().empty(); ++lines) words.skip_line();
  return lines;
}

/// Do vertices and faces, one after the other wherever lines end, make the whole file?
bool runs_on(Words words, const Layout& layout) {
  std::string_view word;
  const auto skip = [&](std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
      if ((word = words.next()).empty()) return false;
    return true;
  };
  for (std::size_t i = 0; i < layout.vertices; ++i)
    if (!skip(3 + layout.attributes)) return false;
  for (std::size_t i = 0; i < layout.faces; ++i)
    if (!skip(1) || !skip(parse<std::size_t>(word).value_or(0))) return false;
  return words.ended();
}

/// A file with a line for each vertex and face is taken to mean it so; one with fewer runs on, and one with
/// more where that comes out even.
bool is_in_lines(const Words& words, const Layout& layout) {
  const std::size_t lines = count_lines(words), items = layout.vertices + layout.faces;
  return lines == items || (lines > items && !runs_on(words, layout));
}

[[noreturn]] void refuse_end(const Words& words, std::string_view what, std::size_t have, std::size_t want) {
  throw words.error(fmt::format("ends after {} {}, expected {}", have, what, want));
}

std::vector<std::uint32_t> read_face(Words& words, const Layout& layout) {
  const auto next = [&](bool first) {
    return layout.in_lines && !first ? words.next_in_line() : words.next();
  };
  const std::string_view word = next(true);
  const auto size = parse<std::size_t>(word);
  if (!size || *size < 3)
    throw words.error(fmt::format("face of '{}' corners, expected 3 or more", shown(word)));
  std::vector<std::uint32_t> corners;
  for (std::size_t k = 0; k < *size; ++k) {
    const std::string_view corner = next(false);
    const auto index = parse<std::uint32_t>(corner);
    if (!index || *index >= layout.vertices)
      throw words.error(fmt::format("vertex index '{}', expected 0 to {}", shown(corner),
                                    std::ptrdiff_t(layout.vertices) - 1));
    corners.push_back(*index);
  }
  if (layout.in_lines) words.skip_line();
  return corners;
}

}  // namespace

MeshReading read_off(const MeshFile& file) {
  Words words(file);
  Layout layout = read_counts(words);
  if (layout.vertices > UINT32_MAX)
    throw words.error(fmt::format("{} vertices, expected fewer than 2^32", layout.vertices));
  layout.in_lines = is_in_lines(words, layout);
  PolygonMesh mesh;  // grows with what is there: the counts of a broken file are not to be trusted
  Digits digits;
  for (std::size_t i = 0; i < layout.vertices; ++i) {
    if (words.ended()) refuse_end(words, "vertices", i, layout.vertices);
    mesh.vertices.push_back(words.point(i + 1, digits, layout.in_lines));
    if (layout.in_lines)
      words.skip_line();
    else
      for (std::size_t k = 0; k < layout.attributes; ++k) (void)words.next();
  }
  for (std::size_t i = 0; i < layout.faces; ++i) {
    if (words.ended()) refuse_end(words, "faces", i, layout.faces);
    mesh.add(read_face(words, layout));
  }
  if (!layout.in_lines && !words.ended())
    throw words.error(fmt::format("more than {} faces, expected the end of the file", layout.faces));
  MeshReading reading = triangulated(std::move(mesh));
  reading.weld = digits.weld(largest_coordinate(reading.mesh));
  return reading;
}

}  // namespace kreisel::core
