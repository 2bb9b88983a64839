// triangulation.hpp - a triangle with points and lines in it, as triangles, whatever the rounding.
#pragma once

#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "geometry/exact_plane.hpp"

namespace kreisel::core {

/// A triangulation of numbered points in the plane by incremental insertion [Lawson 1977]. All signs on which
/// its soundness rests are exact; edges are turned towards Delaunay's in double precision, without promise.
class Triangulation {
 public:
  /// @param plane  outlives this  @param whole  counter-clockwise in it
  Triangulation(const ExactPlane& plane, const Triangle& whole);

  /// Counter-clockwise.
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }

  /// @param p  within the whole triangle, at none of the points that are there
  void insert(std::uint32_t p);

  /// Makes a fixed edge of two points, between which there is no other, and no fixed edge.
  void connect(std::uint32_t a, std::uint32_t b);

  /// Turns edges that are not fixed, so that triangles are less thin.
  void improve();

 private:
  using Edge = std::array<std::uint32_t, 2>;
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

  [[nodiscard]] std::uint32_t beside(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] std::uint32_t apex(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] std::uint32_t locate(std::uint32_t p) const;
  [[nodiscard]] bool can_turn(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool should_turn(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] Edge first_between(std::uint32_t a, std::uint32_t b) const;
  void set(std::uint32_t t, const Triangle& triangle);
  std::uint32_t add(const Triangle& triangle);
  Edge turn(std::uint32_t a, std::uint32_t b);
  void settle(std::vector<Edge> edges);

  const ExactPlane& plane_;
  std::vector<Triangle> triangles_;
  std::unordered_map<std::uint64_t, std::uint32_t> left_of_;  ///< the triangle left of each directed edge
  std::unordered_map<std::uint32_t, std::uint32_t> at_;       ///< a triangle at each point
  std::unordered_set<std::uint64_t> fixed_;                   ///< lower number first
};

}  // namespace kreisel::core
