// landscape.hpp - how large a plane shape nests in another, wherever it is put. [Nest, fig. 7]
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "nest/plane/polygon.hpp"
#include "nest/plane/radial.hpp"

namespace kreisel::core::nest {

/// A plane shape B in another, A: cut horizontally through B's centroid, the halves of A leave up and down.
///
/// At a height y of the cut, let V(y) be what of A can be reached from the cut straight upwards or downwards
/// within A. B nests at c if and only if T(B) lies in V(c.y), for the segment from every point of it back to
/// the cut then lies in A. Scaling moves points along rays from c, so all is decided ray by ray: with t a
/// ray's distance to the border of V and r that to B's at scale 1, both seen from c,
///
///     s <= t(angle) / r(angle - turn)      for every angle,
///
/// and where a ray crosses a border more than once, no part of it that lies in s B may leave V. The largest
/// such scale is found as everywhere here from above: each part that does leave it rules out an interval of
/// scales, and the next is its lower end.
struct PlaneShapes {
  Polygon outer, inner;  ///< the inner one about its centroid, which lies in it
};

/// @throws InputError  polygons without area, or an inner one whose centroid lies outside it
[[nodiscard]] PlaneShapes plane_shapes(Polygon outer, Polygon inner);

/// One centroid, seen in all directions; all rotations are shifts by whole directions. Not to be shared by
/// threads.
class PlaneSearch {
 public:
  /// @param directions  a ray each, a multiple of 64. A contact between two rays is missed, so that a scale
  ///                    may be too large by about their angle times the slopes of both borders
  /// @throws InputError  directions out of range
  PlaneSearch(const PlaneShapes& shapes, const std::vector<Vec2>& directions);

  /// What is open to the cut about `centroid`, with it inside.
  void put(std::span<const Vec2> open, const Vec2& centroid) { seen_.see(open, centroid); }

  /// The largest scale with B turned by `turn` directions, counter-clockwise; at most `floor` as soon as none
  /// above that is possible.
  [[nodiscard]] float largest(int turn, float floor);

  [[nodiscard]] std::uint64_t descents() const { return descents_; }  ///< that were not given up at once

 private:
  [[nodiscard]] float guess(int turn, float floor);
  [[nodiscard]] float bound(int turn, float scale, float floor);
  [[nodiscard]] float descend(int turn, float scale, float floor);
  [[nodiscard]] float ratio(std::size_t block, int turn) const;
  void decided_by(int direction, int turn);
  [[nodiscard]] float lowered(int direction, int turn, float scale) const;

  Radial seen_, inner_;
  std::vector<float> reciprocal_;  ///< 1 / nearest border of B, twice over, so that a shift needs no wrapping
  // What decided last: blocks of rays, and single rays, as seen by A and by B.
  std::size_t blocking_outer_ = 0, blocking_inner_ = 0;
  std::array<int, 4> deciding_outer_{}, deciding_inner_{};
  std::uint64_t descents_ = 0;
};

struct LandscapeSpec {
  int columns = 256;       ///< centroids along the longer side of the outer shape's box, >= 1
  int rotations = 65536;   ///< of the whole turn, >= 1
  int directions = 65536;  ///< rays, a multiple of the rotations and of 64
  bool abort = true;       ///< give rotations up that cannot exceed the best of their centroid
};

/// The largest scale of every centroid over all rotations.
struct Landscape {
  int nx = 0, ny = 0;
  Vec2 origin = Vec2::Zero();  ///< of the first centroid; the others follow x fastest
  double step = 0;
  std::vector<float> scale;   ///< [nx * ny]; 0: the centroid lies outside
  std::vector<int> rotation;  ///< that reaches it, of spec.rotations
  std::uint64_t inside = 0, descents = 0;
  double seconds = 0;
  bool complete = true;

  [[nodiscard]] Vec2 at(std::size_t index) const {
    const auto n = static_cast<std::size_t>(nx);
    return origin + step * Vec2(static_cast<double>(index % n), static_cast<double>(index / n));
  }
  [[nodiscard]] std::size_t best() const;  ///< index
};

/// Rows on all threads; the result does not depend on their number.
/// @param go_on  asked after each row, with how many are done of how many; false ends it
/// @throws InputError  counts out of range
[[nodiscard]] Landscape landscape(const PlaneShapes& shapes, const LandscapeSpec& spec,
                                  const std::function<bool(int done, int rows)>& go_on = {});

}  // namespace kreisel::core::nest
