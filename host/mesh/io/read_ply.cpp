#include "mesh/io/read_ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/io/ply_header.hpp"
#include "mesh/io/ply_numbers.hpp"
#include "mesh/io/polygons.hpp"

namespace kreisel::core {
namespace {

using ply::Element;
using ply::Numbers;
using ply::Property;

void require_coordinates(const MeshFile& file, const Element& vertex) {
  for (const std::string_view name : {"x", "y", "z"})
    if (std::none_of(vertex.properties.begin(), vertex.properties.end(),
                     [&](const Property& p) { return p.name == name && !p.count_type; }))
      throw InputError(
          fmt::format("{}: element 'vertex' has no property '{}', expected x, y and z", file.name, name));
}

void read_vertices(Numbers& numbers, const Element& element, std::vector<Vec3>& vertices) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    numbers.at(element, i);
    Vec3 p;
    for (const Property& property : element.properties) {
      const std::string& name = property.name;
      if (property.count_type || name.size() != 1 || name[0] < 'x' || name[0] > 'z')
        numbers.skip(property);
      else
        p[name[0] - 'x'] = numbers.coordinate(property);
    }
    vertices.push_back(p);
  }
}

bool is_corner_list(const Property& p) {
  return p.count_type && (p.name == "vertex_indices" || p.name == "vertex_index");
}

constexpr std::uint32_t strip_ends = ~0u;

/// The corners of a face; or of strips of triangles one after the other, with `strip_ends` for -1 between
/// them.
std::vector<std::uint32_t> read_corners(Numbers& numbers, const Property& property, std::uint64_t vertices,
                                        bool strips) {
  std::vector<std::uint32_t> corners;
  const std::size_t length = numbers.list_length(property);
  for (std::size_t k = 0; k < length; ++k) {
    const double index = numbers.next(property.type);
    if (strips && index == -1)
      corners.push_back(strip_ends);
    else if (index >= 0 && index < double(vertices) && index == std::floor(index))
      corners.push_back(std::uint32_t(index));
    else
      throw numbers.error(
          fmt::format("vertex index {}, expected 0 to {}", index, std::int64_t(vertices) - 1));
  }
  return corners;
}

void read_faces(Numbers& numbers, const Element& element, std::uint64_t vertices, PolygonMesh& mesh) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    numbers.at(element, i);
    for (const Property& property : element.properties) {
      if (!is_corner_list(property)) {
        numbers.skip(property);
        continue;
      }
      const auto corners = read_corners(numbers, property, vertices, false);
      if (corners.size() < 3)
        throw numbers.error(fmt::format("{} corners, expected 3 or more", corners.size()));
      mesh.add(corners);
    }
  }
}

/// Each corner of a strip makes a triangle with the two before it; every second one runs the other way round.
/// A corner that is repeated turns or moves the strip and makes none.
void add_strips(std::span<const std::uint32_t> corners, PolygonMesh& mesh) {
  std::size_t first = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (corners[k] == strip_ends) {
      first = k + 1;
    } else if (k >= first + 2) {
      const bool odd = (k - first) % 2 == 1;
      const std::uint32_t a = corners[k - 2], b = corners[k - 1], c = corners[k];
      if (a == b || b == c || c == a) continue;
      mesh.add(odd ? Triangle{b, a, c} : Triangle{a, b, c});
    }
  }
}

void read_strips(Numbers& numbers, const Element& element, std::uint64_t vertices, PolygonMesh& mesh) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    numbers.at(element, i);
    for (const Property& property : element.properties)
      if (is_corner_list(property))
        add_strips(read_corners(numbers, property, vertices, true), mesh);
      else
        numbers.skip(property);
  }
}

const Element* find(const ply::Header& header, std::string_view name) {
  const auto at = std::ranges::find(header.elements, name, &Element::name);
  return at == header.elements.end() ? nullptr : &*at;
}

void require_corner_list(const MeshFile& file, const Element& element) {
  if (std::count_if(element.properties.begin(), element.properties.end(), is_corner_list) != 1)
    throw InputError(
        fmt::format("{}: element '{}' needs one list 'vertex_indices', expected it in the header", file.name,
                    element.name));
}

}  // namespace

MeshReading read_ply(const MeshFile& file) {
  const ply::Header header = ply::read_header(file);
  const Element *vertex = find(header, "vertex"), *face = find(header, "face"),
                *strips = find(header, "tristrips");
  if (!vertex || (!face && !strips))
    throw InputError(fmt::format("{}: no element '{}' in the header, expected vertex and face", file.name,
                                 vertex ? "face" : "vertex"));
  require_coordinates(file, *vertex);
  for (const Element* element : {face, strips})
    if (element) require_corner_list(file, *element);
  if (vertex->count > UINT32_MAX - 1)
    throw InputError(fmt::format("{}: {} vertices, expected fewer than 2^32 - 1", file.name, vertex->count));

  Numbers numbers(file, header);
  PolygonMesh mesh;  // grows with what is there: the counts of a broken file are not to be trusted
  for (const Element& element : header.elements) {
    if (&element == vertex) {
      read_vertices(numbers, element, mesh.vertices);
    } else if (&element == face) {
      read_faces(numbers, element, vertex->count, mesh);
    } else if (&element == strips) {
      read_strips(numbers, element, vertex->count, mesh);
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i) {
        numbers.at(element, i);
        for (const Property& property : element.properties) numbers.skip(property);
      }
    }
  }
  numbers.require_end();
  MeshReading reading = triangulated(std::move(mesh));
  reading.weld = numbers.digits().weld(largest_coordinate(reading.mesh));
  return reading;
}

}  // namespace kreisel::core
