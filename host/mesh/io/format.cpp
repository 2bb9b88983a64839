#include "mesh/io/format.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/io/read_3mf.hpp"
#include "mesh/io/read_obj.hpp"
#include "mesh/io/read_off.hpp"
#include "mesh/io/read_ply.hpp"
#include "mesh/io/read_stl.hpp"

namespace kreisel::core {

const std::vector<MeshFormat>& mesh_formats() {
  static const std::vector<MeshFormat> formats = {
      {".stl", "STL", Precision::as_single, false, read_stl, encode_stl},
      {".3mf", "3MF", Precision::as_single_about_place, true, read_3mf, encode_3mf, encode_3mf_objects,
       read_3mf_objects},
      {".obj", "OBJ", Precision::as_double, false, read_obj, encode_obj},
      {".ply", "PLY", Precision::as_double, false, read_ply, encode_ply},
      {".off", "OFF", Precision::as_double, false, read_off, encode_off},
  };
  return formats;
}

const MeshFormat& mesh_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  std::string known;
  const auto& formats = mesh_formats();
  for (std::size_t i = 0; i < formats.size(); ++i) {
    if (formats[i].extension == extension) return formats[i];
    known += i == 0 ? "" : i + 1 == formats.size() ? " or " : ", ";
    known += formats[i].extension;
  }
  throw InputError(
      fmt::format("{}: extension '{}', expected {}", path.string(), path.extension().string(), known));
}

}  // namespace kreisel::core
