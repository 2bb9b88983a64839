// surface_rays.hpp - where does a ray first meet a mesh?
#pragma once

#include <memory>
#include <optional>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Embree's watertight rays, in single precision: distances are right to about 1e-6 of the mesh's size,
/// wherever it lies. Safe to ask from several threads.
class SurfaceRays {
 public:
  struct Hit {
    double distance;         ///< in lengths of the direction
    bool out;                ///< whether the ray leaves the solid there
    std::uint32_t triangle;  ///< of the mesh
  };

  explicit SurfaceRays(const TriangleMesh& mesh);
  ~SurfaceRays();
  SurfaceRays(const SurfaceRays&) = delete;
  SurfaceRays& operator=(const SurfaceRays&) = delete;

  /// The first hit between two distances, if any.
  [[nodiscard]] std::optional<Hit> first(const Vec3& from, const Vec3& direction, double least,
                                         double most) const;

 private:
  std::unique_ptr<class EmbreeScene> scene_;
};

}  // namespace kreisel::core
