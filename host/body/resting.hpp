// resting.hpp - what a body can lie on: facets of its convex hull. [Goldberg, Mirtich, Zhuang, Craig,
// Carlisle, Canny 1999, Part Pose Statistics]
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "body/support_polygon.hpp"
#include "geometry/convex_hull.hpp"
#include "geometry/polygon.hpp"

namespace kreisel::core {

/// The hull of a mesh, computed when it is first asked for. Any thread may ask; copies share it.
class LazyHull {
 public:
  /// Of these vertices. The same ones every time.
  [[nodiscard]] const ConvexHull& of(const std::vector<Vec3>& vertices) const;

 private:
  struct Made {
    std::once_flag once;
    ConvexHull hull;
  };
  std::shared_ptr<Made> made_ = std::make_shared<Made>();
};

/// Facets that carry a body together: those of the hull that are no farther than 0.1 mm and 0.5 degrees from
/// the plane of one of them. Half a degree is what nobody sees, a tenth of a millimetre what a printer leaves
/// open.
struct Ground {
  std::vector<std::uint32_t> facets;  ///< first the one whose plane it is, the largest
  Vec3 down = -Vec3::UnitZ();         ///< outward normal of that one
  /// Whether the hull curves on around it: nine tenths of its rim bend by less than ten degrees. What is
  /// small and rounded is a place to roll over.
  bool rounded = false;
};
constexpr double ground_play = 0.1;  ///< mm
constexpr double ground_degrees = 0.5;

/// The ground under a body whose up direction is `up`: the largest within 0.5 degrees of it.
/// @param hull  mm  @param up  of length 1  @return  nothing: it stands on a corner or an edge
[[nodiscard]] std::optional<Ground> ground_of(const ConvexHull& hull, const Vec3& up);

/// One way of lying.
struct RestingPose {
  std::uint32_t facet = 0;  ///< that it lies on, the largest of those that carry it
  Vec3 up;                  ///< of length 1
  double area = 0;          ///< of the facets that carry it
  double inside = 0;  ///< how far the centre of mass is from the edge of what carries it; negative: beside it
  /// That the body, dropped from any orientation alike without a bounce, ends so: the share of the sphere,
  /// seen from the centre of mass, that its facets cover, with those from which it rolls on to them.
  double probability = 0;

  /// Whether the centre of mass is over what carries it.
  [[nodiscard]] bool stable() const { return inside > 0; }
};

/// How a body with this centre of mass comes to rest.
struct Resting {
  std::vector<RestingPose> poses;   ///< one a ground, in the order of the grounds; probabilities sum to 1
  std::vector<std::uint32_t> ends;  ///< by facet: the pose in which a body ends that falls on it
};

/// All grounds of a hull. They do not depend on where the centre of mass is; what is stable does.
class Grounds {
 public:
  /// @param hull  kept
  explicit Grounds(const ConvexHull& hull);

  /// @param centre  of mass, inside
  [[nodiscard]] Resting at(const Vec3& centre) const;
  [[nodiscard]] std::size_t count() const { return grounds_.size(); }

 private:
  struct Carried {
    std::uint32_t facet;
    Vec3 up;
    Eigen::Matrix3d turn;  ///< up becomes z
    SupportPolygon outline;
  };
  const ConvexHull& hull_;
  std::vector<std::uint32_t> ground_of_;  ///< by facet
  std::vector<Carried> grounds_;
};

/// All grounds of a hull, the most probable first, equally probable ones by their area.
/// @param centre  of mass, inside
[[nodiscard]] std::vector<RestingPose> resting_poses(const ConvexHull& hull, const Vec3& centre);

/// The solid angle of a triangle seen from p; positive where p is behind it. [van Oosterom, Strackee 1983]
[[nodiscard]] double solid_angle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
/// Its gradient in p: a sum over the edges, as the field of a current around the triangle. [Biot, Savart]
[[nodiscard]] Vec3 solid_angle_gradient(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace kreisel::core
