#include "deform/held.hpp"

#include <algorithm>
#include <utility>

#include "geometry/distance.hpp"
#include "mesh/query/distance.hpp"
#include "mesh/query/surface_rays.hpp"

namespace kreisel::core {
namespace {

/// 0 up to a distance of 0, 1 from `blend` on. @param slope  gradient of the distance
Freedom fading(double distance, const Vec3& slope, double blend) {
  const double t = distance / blend;
  if (t <= 0) return {0, Vec3::Zero()};
  if (t >= 1) return {};
  return {t * t * (3 - 2 * t), 6 * t * (1 - t) / blend * slope};
}

class Ball final : public Held {
 public:
  Ball(const Vec3& centre, double radius, double blend) : centre_(centre), radius_(radius), blend_(blend) {}
  [[nodiscard]] Freedom at(const Vec3& x) const override {
    const Vec3 from = x - centre_;
    return fading(from.norm() - radius_, from.normalized(), blend_);
  }

 private:
  Vec3 centre_;
  double radius_, blend_;
};

class Below final : public Held {
 public:
  Below(double height, double blend) : height_(height), blend_(blend) {}
  [[nodiscard]] Freedom at(const Vec3& x) const override {
    return fading(x[2] - height_, Vec3::UnitZ(), blend_);
  }

 private:
  double height_, blend_;
};

class AboutAxis final : public Held {
 public:
  AboutAxis(double radius, double blend) : radius_(radius), blend_(blend) {}
  [[nodiscard]] Freedom at(const Vec3& x) const override {
    const Vec3 from(x[0], x[1], 0);
    return fading(from.norm() - radius_, from.normalized(), blend_);
  }

 private:
  double radius_, blend_;
};

class Inside final : public Held {
 public:
  Inside(TriangleMesh mesh, double near, double blend)
      : mesh_(std::move(mesh)), distance_(mesh_), rays_(mesh_), near_(near), blend_(blend) {}
  [[nodiscard]] Freedom at(const Vec3& x) const override {
    // Beside the mesh a ray may pass through an edge; that it leaves tells what is inside all the same.
    const auto hit = rays_.first(x, Vec3(0.35, 0.21, 0.91), 0, 1e9);
    if (hit && hit->out) return {0, Vec3::Zero()};
    const auto nearest = distance_.nearest(x, near_ + blend_);
    if (!nearest) return {};
    const auto [a, b, c] = corners_of(mesh_, mesh_.triangles[*nearest]);
    const Vec3 from = x - nearest_on_triangle(x, a, b, c);
    return fading(from.norm() - near_, from.normalized(), blend_);
  }

 private:
  TriangleMesh mesh_;
  SurfaceDistance distance_;
  SurfaceRays rays_;
  double near_, blend_;
};

/// Their product: as free as all of them let it be.
class Together final : public Held {
 public:
  explicit Together(std::vector<std::unique_ptr<Held>> parts) : parts_(std::move(parts)) {}
  [[nodiscard]] Freedom at(const Vec3& x) const override {
    Freedom all;
    for (const auto& part : parts_) {
      const Freedom one = part->at(x);
      all = {all.value * one.value, one.value * all.gradient + all.value * one.gradient};
    }
    return all;
  }

 private:
  std::vector<std::unique_ptr<Held>> parts_;
};

}  // namespace

std::unique_ptr<Held> held_ball(const Vec3& centre, double radius, double blend) {
  return std::make_unique<Ball>(centre, radius, blend);
}
std::unique_ptr<Held> held_below(double height, double blend) {
  return std::make_unique<Below>(height, blend);
}
std::unique_ptr<Held> held_about_axis(double radius, double blend) {
  return std::make_unique<AboutAxis>(radius, blend);
}
std::unique_ptr<Held> held_inside(TriangleMesh mesh, double near, double blend) {
  return std::make_unique<Inside>(std::move(mesh), near, blend);
}
std::unique_ptr<Held> held_together(std::vector<std::unique_ptr<Held>> parts) {
  return std::make_unique<Together>(std::move(parts));
}

}  // namespace kreisel::core
