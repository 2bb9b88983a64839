#include "nest/search/freedom.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "error.hpp"
#include "unknown_name.hpp"

namespace kreisel::core::nest {
namespace {

using Direction = Eigen::Map<Vec3>;

Vec3 vector_at(std::span<const double> x, std::size_t at) { return {x[at], x[at + 1], x[at + 2]}; }

Eigen::Quaterniond quaternion_at(std::span<const double> x, std::size_t at) {
  return {x[at], x[at + 1], x[at + 2], x[at + 3]};
}

void store(const Vec3& v, std::span<double> x, std::size_t at) { Direction{&x[at]} = v; }

void store(const Eigen::Quaterniond& q, std::span<double> x, std::size_t at) {
  Eigen::Map<Eigen::Vector4d>(&x[at]) << q.w(), q.x(), q.y(), q.z();
}

/// The part of a rotation that turns about `axis`; none where it is a half turn about a line across it.
Eigen::Quaterniond twist(const Eigen::Quaterniond& q, const Vec3& axis) {
  const double along = q.vec().dot(axis), length = std::hypot(q.w(), along);
  if (!(length > 0)) return Eigen::Quaterniond::Identity();
  const Vec3 v = along / length * axis;
  return {q.w() / length, v.x(), v.y(), v.z()};
}

/// The nearest unit vector that leads away from the plane on its normal's side.
Vec3 away_from(const Vec3& direction, const Vec3& normal) {
  const double slope = direction.dot(normal);
  if (slope >= PlacementSpace::least_slope) return direction;
  const Vec3 across = direction - slope * normal;
  const double length = across.norm();
  if (!(length > 0)) return normal;
  constexpr double least = PlacementSpace::least_slope * (1 + 1e-9);
  return least * normal + std::sqrt(1 - least * least) / length * across;
}

}  // namespace

void Freedom::set_free(std::string_view names) {
  constexpr std::array known{"rotation",       "upright", "position", "plane",
                             "centroid-plane", "removal", "all",      "none"};
  rotation = fixed_rotation;
  plane = fixed_plane;
  position = removal = false;
  const auto both = [&](std::string_view one, std::string_view other) {
    return InputError(fmt::format("free '{}' has both {} and {}; expected one of them", names, one, other));
  };
  while (!names.empty()) {
    const std::size_t comma = names.find(',');
    const std::string_view name = names.substr(0, comma);
    if (name == "all") {
      rotation = any_rotation;
      plane = any_plane;
      position = removal = true;
    } else if (name == "rotation" || name == "upright") {
      if (rotation != fixed_rotation) throw both("rotation", "upright");
      rotation = name == "upright" ? upright : any_rotation;
    } else if (name == "plane" || name == "centroid-plane") {
      if (plane != fixed_plane) throw both("plane", "centroid-plane");
      plane = name == "plane" ? any_plane : through_centroid;
    } else if (name == "position") {
      position = true;
    } else if (name == "removal") {
      removal = true;
    } else if (name != "none") {
      throw unknown_name("free part", name, known);
    }
    names.remove_prefix(comma == std::string_view::npos ? names.size() : comma + 1);
  }
}

PlacementSpace::PlacementSpace(const Freedom& freedom, const Box& box, bool with_scale, double largest_scale)
    : freedom_(freedom) {
  std::vector<Block> blocks;
  std::size_t at = 0;
  const auto add = [&](const Block& block) {
    blocks.push_back(block);
    const std::size_t begin = at;
    at += static_cast<std::size_t>(block.size());
    return begin;
  };
  if (with_scale) scale_ = add({Block::number, 0, largest_scale});
  if (freedom.rotation != Freedom::fixed_rotation) rotation_ = add({Block::rotation});
  if (freedom.position)
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t begin = add({Block::number, box.lo[axis], box.hi[axis]});
      if (axis == 0) {
        centroid_ = begin;
        centroid_unit_ = static_cast<std::size_t>((scale_ ? 1 : 0) + (rotation_ ? 3 : 0));
      }
    }
  if (freedom.plane != Freedom::fixed_plane) normal_ = add({Block::direction});
  if (freedom.plane == Freedom::any_plane) offset_ = add({Block::number, -most_offset, most_offset});
  if (freedom.removal) {
    removal_ = add({Block::direction});
    add({Block::direction});
  }
  space_ = Space(std::move(blocks));
}

Vec3 PlacementSpace::normal_of(std::span<const double> x) const {
  return normal_ ? vector_at(x, *normal_) : freedom_.given.cut.normal;
}

Placement PlacementSpace::placement(std::span<const double> x) const {
  Placement placement = freedom_.given;
  if (scale_) placement.pose.scale = x[*scale_];
  if (rotation_) {
    placement.pose.rotation = quaternion_at(x, *rotation_).toRotationMatrix();
    if (freedom_.rotation == Freedom::upright) placement.pose.rotation *= freedom_.given.pose.rotation;
  }
  if (centroid_) placement.pose.centroid = vector_at(x, *centroid_);
  Cut& cut = placement.cut;
  if (normal_) {
    cut.normal = vector_at(x, *normal_);
    cut.offset = cut.normal.dot(placement.pose.centroid) + (offset_ ? x[*offset_] : 0);
    cut.plus = cut.normal;
    cut.minus = -cut.normal;
  }
  if (removal_) {
    cut.plus = vector_at(x, *removal_);
    cut.minus = vector_at(x, *removal_ + 3);
  }
  return placement;
}

void PlacementSpace::project(std::span<double> x) const {
  space_.project(x);
  if (freedom_.rotation == Freedom::upright)
    store(twist(quaternion_at(x, *rotation_), freedom_.up), x, *rotation_);
  if (!removal_) return;
  const Vec3 normal = normal_of(x);
  Direction plus(&x[*removal_]), minus(&x[*removal_ + 3]);
  plus = away_from(plus, normal);
  minus = away_from(minus, -normal);
}

void PlacementSpace::place(std::span<const double> unit, std::span<double> x) const {
  space_.place(unit, x);
  if (centroid_ && !centres_.empty()) {
    const double u = unit[centroid_unit_];
    const auto n = static_cast<double>(centres_.size());  // u may be 1
    store(centres_[static_cast<std::size_t>(std::min(u * u * n, n - 1))], x, *centroid_);
  }
  if (removal_) {
    // Half of the way from anywhere to the normal: within some 30 degrees of it as a rule.
    const Vec3 normal = normal_of(x);
    Direction plus(&x[*removal_]), minus(&x[*removal_ + 3]);
    plus += 2 * normal;
    minus -= 2 * normal;
  }
  project(x);
}

std::vector<double> PlacementSpace::position(const Placement& placement) const {
  std::vector<double> x(static_cast<std::size_t>(space_.size()));
  if (scale_) x[*scale_] = placement.pose.scale;
  if (rotation_) {
    Eigen::Matrix3d rotation = placement.pose.rotation;
    if (freedom_.rotation == Freedom::upright) rotation *= freedom_.given.pose.rotation.transpose();
    store(Eigen::Quaterniond(rotation), x, *rotation_);
  }
  if (centroid_) store(placement.pose.centroid, x, *centroid_);
  if (normal_) store(placement.cut.normal, x, *normal_);
  if (offset_) x[*offset_] = placement.cut.offset - placement.cut.normal.dot(placement.pose.centroid);
  if (removal_) {
    store(placement.cut.plus, x, *removal_);
    store(placement.cut.minus, x, *removal_ + 3);
  }
  project(x);
  return x;
}

}  // namespace kreisel::core::nest
