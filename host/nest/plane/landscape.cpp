#include "nest/plane/landscape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "error.hpp"
#include "parallel.hpp"
#include "stopwatch.hpp"

namespace kreisel::core::nest {
namespace {

constexpr std::size_t block = 64;  ///< rays whose ratios are formed at once
constexpr std::size_t stride = 16;
constexpr int most_directions = 1 << 20;

/// Each sweep over the rotations takes steps that are this much finer than those of the one before.
constexpr int finer = 16;

int coarsest(int rotations) {
  int skip = 1;
  while (skip * finer * finer < rotations) skip *= finer;
  return skip;
}

using Block = Eigen::Array<float, block, 1>;

}  // namespace

PlaneShapes plane_shapes(Polygon outer, Polygon inner) {
  for (const Polygon* polygon : {&outer, &inner})
    if (polygon->size() < 3 || !(area(*polygon) > 0))
      throw InputError(
          fmt::format("outline of {} points encloses no area counter-clockwise; expected one that does",
                      polygon->size()));
  const Vec2 centre = centroid(inner);
  for (Vec2& p : inner) p -= centre;
  if (!contains(inner, Vec2::Zero()))
    throw InputError("the inner shape's centroid lies outside it; expected it inside");
  return {std::move(outer), std::move(inner)};
}

PlaneSearch::PlaneSearch(const PlaneShapes& shapes, const std::vector<Vec2>& directions)
    : seen_(directions), inner_(directions) {
  if (directions.empty() || directions.size() % block || directions.size() > most_directions)
    throw InputError(fmt::format("{} directions; expected a multiple of {} up to {}", directions.size(),
                                 block, most_directions));
  inner_.see(shapes.inner, Vec2::Zero());
  for (const float r : inner_.nearest()) reciprocal_.push_back(1 / r);
  reciprocal_.insert(reciprocal_.end(), reciprocal_.begin(), reciprocal_.end());
}

/// The least of t / r over a block of rays.
float PlaneSearch::ratio(std::size_t b, int turn) const {
  const std::vector<float>& t = seen_.nearest();
  const std::size_t inner = (b * block + t.size() - static_cast<std::size_t>(turn)) % t.size();
  return (Eigen::Map<const Block>(t.data() + b * block) * Eigen::Map<const Block>(reciprocal_.data() + inner))
      .minCoeff();
}

/// What was in the way of the last rotations may be in the way of this one: the same part of A, or of B.
float PlaneSearch::guess(int turn, float floor) {
  const std::size_t n = seen_.nearest().size(), shift = static_cast<std::size_t>(turn);
  float scale = std::min(ratio(blocking_outer_, turn), ratio((blocking_inner_ + shift) % n / block, turn));
  for (std::size_t k = 0; k < deciding_outer_.size() && scale > floor; ++k)
    for (const int direction : {deciding_outer_[k], static_cast<int>((deciding_inner_[k] + shift) % n)})
      scale = lowered(direction, turn, scale);
  return scale;
}

/// Every ray's first crossings.
float PlaneSearch::bound(int turn, float scale, float floor) {
  const std::size_t n = seen_.nearest().size();
  for (std::size_t first = 0; first < stride; ++first)
    for (std::size_t b = first; b < n / block && scale > floor; b += stride)
      if (const float here = ratio(b, turn); here < scale) {
        scale = here;
        blocking_outer_ = b;
        blocking_inner_ = (b * block + n - static_cast<std::size_t>(turn)) % n;
      }
  return scale;
}

void PlaneSearch::decided_by(int direction, int turn) {
  const int n = static_cast<int>(seen_.nearest().size());
  std::rotate(deciding_outer_.begin(), deciding_outer_.end() - 1, deciding_outer_.end());
  std::rotate(deciding_inner_.begin(), deciding_inner_.end() - 1, deciding_inner_.end());
  deciding_outer_.front() = direction;
  deciding_inner_.front() = (direction - turn + n) % n;
}

/// The largest scale up to `scale` at which no part of one ray that lies in s B leaves V. Inside V the ray is
/// up to its first crossing, outside up to the second, and so on; the same for B.
float PlaneSearch::lowered(int direction, int turn, float scale) const {
  const int n = static_cast<int>(seen_.nearest().size());
  const std::span<const float> outer = seen_.crossings(direction),
                               inner = inner_.crossings((direction - turn + n) % n);
  for (bool again = true; again;) {
    again = false;
    for (std::size_t j = 0; j < outer.size(); j += 2)
      for (std::size_t k = 0; k < inner.size(); k += 2) {
        const float end = j + 1 < outer.size() ? outer[j + 1] : std::numeric_limits<float>::infinity();
        const float from = k ? inner[k - 1] : 0, to = inner[k];
        if (!(scale * to > outer[j] && scale * from < end)) continue;
        // Round-off alone may leave the product above what it was divided from.
        scale = std::min(outer[j] / to, std::nextafter(scale, 0.0f));
        again = true;
      }
  }
  return scale;
}

/// Every ray that crosses a border more than once; of the others bound() has said it all.
float PlaneSearch::descend(int turn, float scale, float floor) {
  const int n = static_cast<int>(seen_.nearest().size());
  ++descents_;
  int deciding = -1;
  const auto along = [&](int direction) {
    const float next = lowered(direction, turn, scale);
    if (next < scale) {
      scale = next;
      deciding = direction;
    }
    return scale > floor;
  };
  // Neighbours fail together: every 16th ray is likely to find what any does.
  const std::vector<int>&outer_rays = seen_.several(), &inner_rays = inner_.several();
  const auto pass = [&] {
    for (std::size_t first = 0; first < stride; ++first) {
      for (std::size_t k = first; k < outer_rays.size(); k += stride)
        if (!along(outer_rays[k])) return;
      for (std::size_t k = first; k < inner_rays.size(); k += stride)
        if (!along((inner_rays[k] + turn) % n)) return;
    }
  };
  for (float before = std::numeric_limits<float>::infinity(); scale < before && scale > floor;) {
    before = scale;
    pass();
  }
  if (deciding >= 0) decided_by(deciding, turn);
  return scale;
}

float PlaneSearch::largest(int turn, float floor) {
  float scale = guess(turn, floor);
  if (scale > floor) scale = bound(turn, scale, floor);
  return scale > floor ? descend(turn, scale, floor) : scale;
}

std::size_t Landscape::best() const {
  return static_cast<std::size_t>(std::ranges::max_element(scale) - scale.begin());
}

namespace {

void require_valid(const LandscapeSpec& spec) {
  if (spec.columns < 1 || spec.columns > 4096)
    throw InputError(fmt::format("landscape of {} columns; expected 1 to 4096", spec.columns));
  if (spec.rotations < 1 || spec.rotations > most_directions || spec.directions % spec.rotations)
    throw InputError(fmt::format("{} rotations by {} directions; expected a divisor of them", spec.rotations,
                                 spec.directions));
}

/// Without its scales: all lie outside.
Landscape empty_landscape(const PlaneShapes& shapes, const LandscapeSpec& spec) {
  const auto box = bounding_box(shapes.outer);
  Landscape map;
  map.step = box.extent().maxCoeff() / spec.columns;
  const auto cells = [&](int axis) {
    return std::max(1, static_cast<int>(std::ceil(box.extent()[axis] / map.step - 1e-9)));
  };
  map.nx = cells(0);
  map.ny = cells(1);
  map.origin = box.lo + Vec2::Constant(map.step / 2);
  const auto count = static_cast<std::size_t>(map.nx) * static_cast<std::size_t>(map.ny);
  map.scale.assign(count, 0);
  map.rotation.assign(count, 0);
  return map;
}

/// The best rotation of the centroid that the search looks from, and its scale. @param first  to begin with
std::pair<int, float> best_rotation(PlaneSearch& search, const LandscapeSpec& spec, int first) {
  const int turn = spec.directions / spec.rotations;
  std::pair<int, float> best{0, 0};
  // Coarse turns first: the finer ones then have a high floor, and only those about a peak pass it.
  for (int skip = coarsest(spec.rotations); skip >= 1; skip /= finer)
    for (int k = 0; k < spec.rotations; k += skip) {
      const int rotation = (first + k) % spec.rotations;
      const float scale = search.largest(rotation * turn, spec.abort ? best.second : 0);
      if (scale > best.second) best = {rotation, scale};
    }
  return best;
}

}  // namespace

Landscape landscape(const PlaneShapes& shapes, const LandscapeSpec& spec,
                    const std::function<bool(int done, int rows)>& go_on) {
  require_valid(spec);
  const Stopwatch watch;
  Landscape found = empty_landscape(shapes, spec);
  const Polygon rays = circle(Vec2::Zero(), 1, spec.directions);
  std::atomic<bool> stopped = false;
  std::atomic<int> done = 0;
  std::vector<std::uint64_t> inside(static_cast<std::size_t>(found.ny), 0), descents(inside);
  parallel_for(static_cast<std::size_t>(found.ny), [&](std::size_t row) {
    if (stopped) return;
    const double height = found.origin.y() + found.step * static_cast<double>(row);
    const std::vector<OpenPart> parts = open_to(shapes.outer, height);
    PlaneSearch search(shapes, rays);
    int first = 0;  // the best rotation of the centroid before is a good one to begin with
    for (std::size_t column = 0; column < static_cast<std::size_t>(found.nx); ++column) {
      const std::size_t index = row * static_cast<std::size_t>(found.nx) + column;
      const Vec2 centroid = found.at(index);
      const auto part = std::ranges::find_if(
          parts, [&](const OpenPart& p) { return p.x0 < centroid.x() && centroid.x() < p.x1; });
      if (part == parts.end()) continue;
      ++inside[row];
      search.put(part->outline, centroid);
      std::tie(found.rotation[index], found.scale[index]) = best_rotation(search, spec, first);
      first = found.rotation[index];
    }
    descents[row] = search.descents();
    if (const int so_far = ++done; go_on && !go_on(so_far, found.ny)) stopped = true;
  });
  for (const std::uint64_t n : inside) found.inside += n;
  for (const std::uint64_t n : descents) found.descents += n;
  found.complete = done == found.ny;
  found.seconds = watch.seconds();
  return found;
}

}  // namespace kreisel::core::nest
