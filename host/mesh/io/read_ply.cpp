// Not OpenMesh's PLY reader: release 9 narrows coordinates to float and takes what a cut-off file still
// holds.
#include "mesh/io/read_ply.hpp"

#include <bit>
#include <cstring>

#include "mesh/io/ply_header.hpp"

namespace kreisel::core {
namespace {

using ply::Element;
using ply::Encoding;
using ply::Property;
using ply::Type;

static_assert(std::endian::native == std::endian::little, "byte order of binary PLY");

std::size_t size_of(Type type) {
  switch (type) {
    case Type::int8:
    case Type::uint8:
      return 1;
    case Type::int16:
    case Type::uint16:
      return 2;
    case Type::int32:
    case Type::uint32:
    case Type::float32:
      return 4;
    case Type::float64:
      break;
  }
  return 8;
}

/// The numbers behind the header, one after the other. Double holds every PLY type exactly.
class Numbers {
 public:
  Numbers(const MeshFile& file, const ply::Header& header)
      : file_(file), encoding_(header.encoding), rest_(std::string_view(file.bytes).substr(header.body)) {}

  /// Names what is being read, for the errors.
  void at(const Element& element, std::uint64_t index) {
    element_ = &element;
    index_ = index;
  }

  double next(Type type) { return encoding_ == Encoding::ascii ? from_text() : from_bytes(type); }

  void require_end() {
    if (encoding_ == Encoding::ascii) {
      if (const std::string_view word = text_word(); !word.empty())
        throw InputError(fmt::format("{}: '{}' behind the last element, expected the end of the file",
                                     file_.name, shown(word)));
    } else if (rest_.find_first_not_of(" \t\r\n") != std::string_view::npos) {
      throw InputError(fmt::format("{}: {} bytes behind the last element, expected the end of the file",
                                   file_.name, rest_.size()));
    }
  }

  [[nodiscard]] InputError error(std::string_view what) const {
    return InputError(fmt::format("{}: {} {}: {}", file_.name, element_->name, index_ + 1, what));
  }

 private:
  std::string_view text_word() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n\v\f"), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r\n\v\f"));
    rest_.remove_prefix(word.size());
    return word;
  }

  [[nodiscard]] InputError cut_off() const {
    return error(fmt::format("the file ends here, expected {} of them", element_->count));
  }

  double from_text() {
    const std::string_view word = text_word();
    if (word.empty()) throw cut_off();
    const auto value = parse<double>(word);
    if (!value) throw error(fmt::format("'{}', expected a finite number", shown(word)));
    return *value;
  }

  double from_bytes(Type type) {
    char bytes[8] = {};
    const std::size_t size = size_of(type);
    if (rest_.size() < size) throw cut_off();
    std::memcpy(bytes, rest_.data(), size);
    rest_.remove_prefix(size);
    if (encoding_ == Encoding::big_endian) std::reverse(bytes, bytes + size);
    const auto as = [&]<class T>(T value) {
      std::memcpy(&value, bytes, sizeof value);
      return static_cast<double>(value);
    };
    switch (type) {
      case Type::int8:
        return as(std::int8_t{});
      case Type::uint8:
        return as(std::uint8_t{});
      case Type::int16:
        return as(std::int16_t{});
      case Type::uint16:
        return as(std::uint16_t{});
      case Type::int32:
        return as(std::int32_t{});
      case Type::uint32:
        return as(std::uint32_t{});
      case Type::float32:
        return as(float{});
      case Type::float64:
        break;
    }
    return as(double{});
  }

  const MeshFile& file_;
  Encoding encoding_;
  std::string_view rest_;
  const Element* element_ = nullptr;
  std::uint64_t index_ = 0;
};

std::size_t list_length(Numbers& numbers, const Property& property) {
  const double length = numbers.next(*property.count_type);
  if (!(length >= 0 && length == std::floor(length) && length <= double(UINT32_MAX)))
    throw numbers.error(fmt::format("list '{}' of length {}, expected 0 or more", property.name, length));
  return std::size_t(length);
}

void skip(Numbers& numbers, const Property& property) {
  const std::size_t length = property.count_type ? list_length(numbers, property) : 1;
  for (std::size_t k = 0; k < length; ++k) (void)numbers.next(property.type);
}

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
      if (property.count_type || name.size() != 1 || name[0] < 'x' || name[0] > 'z') {
        skip(numbers, property);
        continue;
      }
      const double value = numbers.next(property.type);
      if (!std::isfinite(value))
        throw numbers.error(fmt::format("coordinate {} is {}, expected a finite number", name, value));
      p[name[0] - 'x'] = value;
    }
    vertices.push_back(p);
  }
}

bool is_corner_list(const Property& p) {
  return p.count_type && (p.name == "vertex_indices" || p.name == "vertex_index");
}

void read_faces(Numbers& numbers, const Element& element, std::uint64_t vertices, TriangleMesh& mesh) {
  std::vector<std::uint32_t> corners;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    numbers.at(element, i);
    for (const Property& property : element.properties) {
      if (!is_corner_list(property)) {
        skip(numbers, property);
        continue;
      }
      corners.clear();
      const std::size_t length = list_length(numbers, property);
      if (length < 3) throw numbers.error(fmt::format("{} corners, expected 3 or more", length));
      for (std::size_t k = 0; k < length; ++k) {
        const double index = numbers.next(property.type);
        if (!(index >= 0 && index < double(vertices) && index == std::floor(index)))
          throw numbers.error(
              fmt::format("vertex index {}, expected 0 to {}", index, std::int64_t(vertices) - 1));
        corners.push_back(std::uint32_t(index));
      }
      add_fan(mesh, corners);
    }
  }
}

const Element& find(const MeshFile& file, const ply::Header& header, std::string_view name) {
  for (const Element& element : header.elements)
    if (element.name == name) return element;
  throw InputError(
      fmt::format("{}: no element '{}' in the header, expected vertex and face", file.name, name));
}

}  // namespace

TriangleMesh read_ply(const MeshFile& file) {
  const ply::Header header = ply::read_header(file);
  const Element &vertex = find(file, header, "vertex"), &face = find(file, header, "face");
  require_coordinates(file, vertex);
  if (std::count_if(face.properties.begin(), face.properties.end(), is_corner_list) != 1)
    throw InputError(fmt::format(
        "{}: element 'face' needs one list 'vertex_indices', expected it in the header", file.name));
  if (vertex.count > UINT32_MAX)
    throw InputError(fmt::format("{}: {} vertices, expected fewer than 2^32", file.name, vertex.count));

  Numbers numbers(file, header);
  TriangleMesh mesh;  // grows with what is there: the counts of a broken file are not to be trusted
  for (const Element& element : header.elements) {
    if (&element == &vertex) {
      read_vertices(numbers, element, mesh.vertices);
    } else if (&element == &face) {
      read_faces(numbers, element, vertex.count, mesh);
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i) {
        numbers.at(element, i);
        for (const Property& property : element.properties) skip(numbers, property);
      }
    }
  }
  numbers.require_end();
  return mesh;
}

}  // namespace kreisel::core
