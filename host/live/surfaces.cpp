#include "live/surfaces.hpp"

#include <vector>

namespace kreisel::core::live {

Message surface(const nlohmann::json& what, const TriangleMesh& mesh) {
  std::vector<float> places;
  places.reserve(3 * mesh.vertices.size());
  for (const Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) places.push_back(static_cast<float>(v[k]));
  nlohmann::json head = what;
  head["do"] = "surface";
  head["corners"] = mesh.vertices.size();
  head["triangles"] = mesh.triangles.size();
  static_assert(sizeof(Triangle) == 3 * sizeof(std::uint32_t));
  std::string bytes(reinterpret_cast<const char*>(places.data()), sizeof(float) * places.size());
  bytes.append(reinterpret_cast<const char*>(mesh.triangles.data()),
               sizeof(Triangle) * mesh.triangles.size());
  return with_bytes(head, bytes);
}

}  // namespace kreisel::core::live
