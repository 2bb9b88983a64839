// distance.hpp - exact distances to a triangle mesh.
#pragma once

#include <memory>
#include <optional>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Distance to the surface of a mesh. Embree's hierarchy finds the candidates in single precision with a
/// margin; the distance to each triangle is computed in double. Safe to ask from several threads.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(const TriangleMesh& mesh);  ///< keeps a reference to the mesh
  ~SurfaceDistance();
  SurfaceDistance(const SurfaceDistance&) = delete;
  SurfaceDistance& operator=(const SurfaceDistance&) = delete;

  /// The distance of `point`, or `limit` when it is at least that. limit > 0, the mesh's unit. The search
  /// ends as soon as it finds a point of the surface nearer than `enough`: the result is then that point's
  /// distance.
  [[nodiscard]] double operator()(const Vec3& point, double limit, double enough = 0) const;

  /// The triangle nearest to `point`, if any is nearer than `limit`; the first found of those equally near.
  [[nodiscard]] std::optional<std::uint32_t> nearest(const Vec3& point, double limit) const;

 private:
  struct Scene;
  struct Query;
  void search(Query& query, double limit) const;
  std::unique_ptr<Scene> scene_;
};

}  // namespace kreisel::core
