// nest_mesh.hpp - the mesh of a shape that is to nest: any mesh will do, it is neither checked nor mended.
#pragma once

#include "body/source.hpp"

namespace kreisel::bench {

/// @param model  a name of `bench list`, or a file
/// @throws InputError  neither
inline TriangleMesh nest_mesh(const std::string& model) {
  BodySpec spec;
  spec.model = model;
  return load_source(spec).mesh;
}

}  // namespace kreisel::bench
