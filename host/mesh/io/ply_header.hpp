// ply_header.hpp - what a PLY file says it holds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/io/mesh_file.hpp"

namespace kreisel::core::ply {

enum class Encoding { ascii, little_endian, big_endian };
enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
  std::string name;
  Type type;
  std::optional<Type> count_type;  ///< of a list: the type of its length
};

struct Element {
  std::string name;
  std::uint64_t count;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding;
  std::vector<Element> elements;
  std::string_view body;  ///< all bytes behind it
};

/// @throws InputError  no PLY file, or a header that does not say what follows; with the line
[[nodiscard]] Header read_header(const MeshFile& file);

}  // namespace kreisel::core::ply
