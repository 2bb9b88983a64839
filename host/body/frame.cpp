#include "body/frame.hpp"

namespace kreisel::core {

TriangleMesh to_body(const Frame& frame, TriangleMesh mesh) {
  for (Vec3& v : mesh.vertices) v = frame.to_body(v);
  return mesh;
}

TriangleMesh to_model(const Frame& frame, TriangleMesh mesh) {
  for (Vec3& v : mesh.vertices) v = frame.to_model(v);
  return mesh;
}

}  // namespace kreisel::core
