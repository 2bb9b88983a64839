// format.hpp - the mesh formats, by the extension of a file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/io/mesh_file.hpp"
#include "mesh/io/mesh_object.hpp"
#include "mesh/io/mesh_reading.hpp"

namespace kreisel::core {

/// What a format keeps of a coordinate.
enum class Precision {
  as_double,
  as_single,              ///< less of it the farther from the origin
  as_single_about_place,  ///< single precision about a place in the file, which may be far away (place_of())
};

/// Everything that is known of a format: a new one is one more entry in format.cpp.
struct MeshFormat {
  std::string_view extension;  ///< lower case, with the dot
  std::string_view name;
  Precision written;
  bool has_unit;  ///< a file says what its lengths are in; read() turns them into millimetres
  MeshReading (*read)(const MeshFile& file);
  /// The bytes of a file of that name with all parts. @throws InputError  something the format cannot hold
  std::string (*encode)(const std::vector<TriangleMesh>& parts, const std::string& name);
  /// The same as several objects with names, and back, in their order; null where a format has no objects.
  std::string (*encode_objects)(const std::vector<MeshObject>& objects, const std::string& name) = nullptr;
  std::vector<TriangleMesh> (*read_objects)(const MeshFile& file) = nullptr;
};

[[nodiscard]] const std::vector<MeshFormat>& mesh_formats();

/// The format of the extension, in any case. @throws InputError  unknown; names those there are
[[nodiscard]] const MeshFormat& mesh_format(const std::filesystem::path& path);

}  // namespace kreisel::core
