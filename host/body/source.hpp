// source.hpp - where a body's mesh comes from.
#pragma once

#include "body/body.hpp"

namespace kreisel {

/// A mesh with what its origin says of it.
struct Source {
  std::string name;
  std::string format;  ///< in words: a file format, or where else it comes from
  TriangleMesh mesh;   ///< as read or made: neither checked nor mended
  bool ours = false;   ///< made by the project: sound by its tests
  Vec3 axis = Vec3::UnitZ(), up = Vec3::UnitZ();
  std::optional<Vec3> contact;
  std::optional<double> size;  ///< to be scaled to, mm
};

/// The model of that name, made or fetched, or the mesh file.
/// @throws InputError  neither a name (says the nearest) nor a readable file; fineness < 0
[[nodiscard]] Source load_source(const BodySpec& spec);

/// Looks at the name alone: a file may still be missing or broken.
/// @throws InputError  neither the name of a model nor like that of a file; says the nearest
void require_known_model(const std::string& model);

}  // namespace kreisel
