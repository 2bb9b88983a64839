#include "nest/landscape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>

#include "error.hpp"
#include "parallel.hpp"

namespace kreisel::nest {
namespace {

constexpr std::size_t block = 64;  ///< rays whose ratios are formed at once
constexpr int most_directions = 1 << 20;

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
  bool inside = false;
  for (const OpenPart& part : open_to(inner, 0)) inside = inside || (part.x0 < 0 && 0 < part.x1);
  if (!inside) throw InputError("the inner shape's centroid lies outside it; expected it inside");
  return {std::move(outer), std::move(inner)};
}

PlaneSearch::PlaneSearch(const PlaneShapes& shapes, const std::vector<Vec2>& directions)
    : seen_(directions), inner_(directions), has_several_(directions.size(), -1) {
  if (directions.empty() || directions.size() % block || directions.size() > most_directions)
    throw InputError(fmt::format("{} directions; expected a multiple of {} up to {}", directions.size(),
                                 block, most_directions));
  inner_.see(shapes.inner, Vec2::Zero());
  for (const float r : inner_.nearest()) reciprocal_.push_back(1 / r);
  reciprocal_.insert(reciprocal_.end(), reciprocal_.begin(), reciprocal_.end());
  std::vector<int> several = inner_.several();
  std::ranges::sort(several);
  for (const int direction : several) {
    has_several_[static_cast<std::size_t>(direction)] = static_cast<int>(inner_several_.size());
    const std::span<const float> crossings = inner_.crossings(direction, room_);
    inner_several_.push_back({direction, {crossings.begin(), crossings.end()}});
  }
}

float PlaneSearch::bound(int turn, float floor) {
  const std::vector<float>& t = seen_.nearest();
  const std::size_t n = t.size(), shift = n - static_cast<std::size_t>(turn);
  const auto least_of = [&](std::size_t b) {
    return (Eigen::Map<const Block>(t.data() + b * block) *
            Eigen::Map<const Block>(reciprocal_.data() + (b * block + shift) % n))
        .minCoeff();
  };
  const auto inner_block = [&](std::size_t b) { return (b * block + shift) % n; };
  float least = std::numeric_limits<float>::infinity();
  // What was in the way last is asked first: the same part of A, then the same part of B.
  const std::size_t guesses[] = {blocking_outer_,
                                 (blocking_inner_ + static_cast<std::size_t>(turn)) % n / block};
  for (const std::size_t b : guesses) {
    least = std::min(least, least_of(b));
    if (least <= floor) return least;
  }
  for (std::size_t b = 0; b < n / block; ++b) {
    const float here = least_of(b);
    if (here >= least) continue;
    least = here;
    blocking_outer_ = b;
    blocking_inner_ = inner_block(b);
    if (least <= floor) return least;
  }
  return least;
}

float PlaneSearch::descend(int turn, float scale, float floor) {
  const int n = static_cast<int>(seen_.nearest().size());
  ++descents_;
  // On one ray: inside V up to outer[0], outside up to outer[1], and so on; the same for B.
  const auto lowered = [&](std::span<const float> outer, std::span<const float> inner) {
    for (bool again = true; again && scale > floor;) {
      again = false;
      for (std::size_t j = 0; j < outer.size(); j += 2)
        for (std::size_t k = 0; k < inner.size(); k += 2) {
          const float end = j + 1 < outer.size() ? outer[j + 1] : std::numeric_limits<float>::infinity();
          const float from = k ? inner[k - 1] : 0, to = inner[k];
          if (scale * to > outer[j] && scale * from < end) {
            const float next = outer[j] / to;
            // Round-off alone may leave the product above what it was divided from.
            scale = next < scale ? next : std::nextafter(scale, 0.0f);
            again = true;
          }
        }
    }
  };
  for (float before = std::numeric_limits<float>::infinity(); scale < before && scale > floor;) {
    before = scale;
    for (const int direction : seen_.several()) {
      const int inner_direction = (direction - turn + n) % n;
      const int place = has_several_[static_cast<std::size_t>(inner_direction)];
      const float single = inner_.nearest()[static_cast<std::size_t>(inner_direction)];
      lowered(seen_.crossings(direction, room_),
              place < 0 ? std::span<const float>(&single, 1)
                        : std::span<const float>(inner_several_[static_cast<std::size_t>(place)].crossings));
      if (scale <= floor) return scale;
    }
    for (const Several& several : inner_several_) {
      lowered(seen_.crossings((several.direction + turn) % n, room_), several.crossings);
      if (scale <= floor) return scale;
    }
  }
  return scale;
}

float PlaneSearch::largest(int turn, float floor) {
  const float most = bound(turn, floor);
  return most <= floor ? most : descend(turn, most, floor);
}

std::size_t Landscape::best() const {
  return static_cast<std::size_t>(std::ranges::max_element(scale) - scale.begin());
}

Landscape landscape(const PlaneShapes& shapes, const LandscapeSpec& spec,
                    const std::function<bool(int done, int rows)>& go_on) {
  if (spec.columns < 1 || spec.columns > 4096)
    throw InputError(fmt::format("landscape of {} columns; expected 1 to 4096", spec.columns));
  if (spec.rotations < 1 || spec.rotations > most_directions || spec.directions % spec.rotations)
    throw InputError(fmt::format("{} rotations by {} directions; expected a divisor of them", spec.rotations,
                                 spec.directions));
  const auto start = std::chrono::steady_clock::now();
  Vec2 lo = shapes.outer.front(), hi = lo;
  for (const Vec2& p : shapes.outer) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  Landscape found;
  found.step = (hi - lo).maxCoeff() / spec.columns;
  const auto cells = [&](int axis) {
    return std::max(1, static_cast<int>(std::ceil((hi - lo)[axis] / found.step - 1e-9)));
  };
  found.nx = cells(0);
  found.ny = cells(1);
  found.origin = lo + Vec2::Constant(found.step / 2);
  const auto count = static_cast<std::size_t>(found.nx) * static_cast<std::size_t>(found.ny);
  found.scale.assign(count, 0);
  found.rotation.assign(count, 0);
  const std::vector<Vec2> rays = directions(spec.directions);
  const int turn = spec.directions / spec.rotations;
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
      float best = 0;
      for (int k = 0; k < spec.rotations; ++k) {
        const int rotation = (first + k) % spec.rotations;
        const float scale = search.largest(rotation * turn, spec.abort ? best : 0);
        if (scale > best) {
          best = scale;
          found.rotation[index] = rotation;
        }
      }
      found.scale[index] = best;
      first = found.rotation[index];
    }
    descents[row] = search.descents();
    if (const int so_far = ++done; go_on && !go_on(so_far, found.ny)) stopped = true;
  });
  for (const std::uint64_t n : inside) found.inside += n;
  for (const std::uint64_t n : descents) found.descents += n;
  found.complete = done == found.ny;
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return found;
}

}  // namespace kreisel::nest
