#include "nest/search/optimise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "error.hpp"
#include "mesh/query/distance.hpp"
#include "mesh/query/surface_rays.hpp"
#include "parallel.hpp"
#include "stopwatch.hpp"
#include "unknown_name.hpp"

namespace kreisel::core::nest {
namespace {

bool all_finite(const std::vector<double>& numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

/// What counts iterations or starts of the swarms: each from 0 to `most`.
bool counts_up_to(int most, const std::vector<int>& numbers) {
  return std::ranges::all_of(numbers, [&](int number) { return number >= 0 && number <= most; });
}

/// A checkpoint may come from a file: whatever is read of it has the length that this search gives it, and
/// values that it can have. @throws UnfitState
void require_same_search(const SearchState& state, const Space& space,
                         const PlacementSearchOptions& options) {
  const auto size = static_cast<std::size_t>(space.size()), steps = static_cast<std::size_t>(space.steps()),
             particles = static_cast<std::size_t>(options.swarm.particles),
             swarms = static_cast<std::size_t>(options.swarm.swarms);
  const SwarmState& s = state.swarm;
  if (s.x.size() != size * particles)
    throw UnfitState(fmt::format("a checkpoint of {} numbers; expected {}: {} particles of {}", s.x.size(),
                                 size * particles, particles, size));
  const auto none_or = [](std::size_t n, std::size_t expected) { return n == 0 || n == expected; };
  const ClimbState& c = state.climb;
  const bool climbing = state.phase == SearchState::climbing;
  const bool same =
      s.v.size() == s.x.size() && s.own.size() == s.x.size() && s.own_value.size() == particles &&
      s.rose.size() == swarms && s.drawn.size() == swarms && s.placed.size() == swarms &&
      s.top.size() == swarms && none_or(s.best.size(), size) && none_or(state.best.size(), size) &&
      !state.trace.empty() &&
      (!climbing || (c.x.size() == size && c.path.size() == steps && c.covariance.size() == steps * steps));
  if (!same)
    throw UnfitState(fmt::format("a checkpoint that does not fit; expected one of {} swarms over {} numbers",
                                 swarms, size));
  const bool possible =
      s.iteration >= 0 && s.iteration <= options.swarm.iterations && counts_up_to(s.iteration, s.rose) &&
      counts_up_to(s.iteration, s.drawn) && counts_up_to(options.swarm.candidates + 1, s.placed) &&
      state.climbs >= 0 && state.climbs <= options.climbs && state.scale >= 0 && std::isfinite(state.scale) &&
      all_finite(s.x) && all_finite(s.v) && all_finite(s.own) && all_finite(s.best) &&
      all_finite(state.best) &&
      (!climbing || (c.iteration >= 0 && std::isfinite(c.step) && std::isfinite(c.success) &&
                     all_finite(c.x) && all_finite(c.path) && all_finite(c.covariance)));
  if (!possible)
    throw UnfitState(
        fmt::format("a checkpoint with numbers that no search has; expected finite ones, after at most {} "
                    "iterations and {} climbs",
                    options.swarm.iterations, options.climbs));
}

void run_swarm(OptimiseResult& result, const Asking& asking, const OptimiseSpec& spec,
               const std::function<bool()>& go_on, const OnIteration& on_iteration,
               const SearchState* resume) {
  const PlacementSearch search(*asking.objective, spec.search);
  if (resume) require_same_search(*resume, asking.objective->space(), spec.search);
  result.state = resume ? *resume : search.start();
  const auto told = [&] { return !on_iteration || on_iteration(result.state); };
  bool more = told() && go_on();
  while (more && search.step(result.state)) {
    if (spec.guest && result.state.phase == SearchState::swarming)
      if (const std::vector<double> x = spec.guest(result.state); !x.empty()) search.take_in(result.state, x);
    more = told() && go_on();
  }
  result.ended_early = result.state.phase != SearchState::over;
}

}  // namespace

Asking make_asking(const Nesting& nesting, device::Device& device, const OptimiseSpec& spec) {
  const bool basic = spec.variant == "basic";
  if (spec.upper && !(*spec.upper > 0))
    throw InputError(fmt::format("upper bound {} of the scale; expected a number > 0", *spec.upper));
  const double upper = std::min(nesting.largest_scale(), spec.upper.value_or(nesting.largest_scale()));
  PlacementSpace space(spec.freedom, nesting.outer_box(), basic, upper);
  if (spec.freedom.position && spec.search.swarm.placing != Placing::anywhere) {
    constexpr int lattice = 4096;
    space.start_near(deep_points(nesting, lattice));
  }
  KeepOuts keep_outs(nesting, spec.keep_outs, spec.surface ? *spec.surface : nesting.outer());
  Asking asking;
  if (basic) {
    asking.feasibility = make_feasibility(spec.test, device, nesting, spec.resolution);
    asking.objective =
        std::make_unique<ScaleInPosition>(std::move(space), std::move(keep_outs), *asking.feasibility);
    return asking;
  }
  asking.search = make_search(spec.test, device, nesting, spec.resolution);
  auto largest = std::make_unique<LargestScale>(std::move(space), std::move(keep_outs), *asking.search, upper,
                                                spec.tolerance, spec.variant == "hybrid+abort");
  asking.largest = largest.get();
  asking.objective = std::move(largest);
  return asking;
}

void finish(OptimiseResult& result, const Asking& asking) {
  if (result.state.scale > 0) {  // the position has no numbers where nothing is free
    result.best = asking.objective->placements().placement(result.state.best);
    result.best->pose.scale = result.state.scale;
  }
  if (asking.largest) {
    result.tests = asking.largest->tests();
    result.aborted = asking.largest->aborted();
  } else {
    result.tests = result.state.evaluations();
  }
}

const std::vector<std::string_view>& variants() {
  static const std::vector<std::string_view> all = {"basic", "hybrid", "hybrid+abort"};
  return all;
}

void require_variant(std::string_view name) {
  if (std::ranges::find(variants(), name) == variants().end())
    throw unknown_name("variant", name, variants());
}

OptimiseResult optimise(const Nesting& nesting, device::Device& device, const OptimiseSpec& spec,
                        const OnIteration& on_iteration, const SearchState* resume) {
  require_variant(spec.variant);
  OptimiseResult result;
  const Stopwatch setup;
  const Asking asking = make_asking(nesting, device, spec);
  result.setup_seconds = setup.seconds();
  const Stopwatch search;
  run_swarm(
      result, asking, spec, [&] { return search.seconds() < spec.seconds; }, on_iteration, resume);
  result.search_seconds = search.seconds();
  finish(result, asking);
  return result;
}

std::vector<Vec3> deep_points(const Nesting& nesting, int count) {
  const Box& box = nesting.outer_box();
  const Vec3 extent = box.extent();
  const double step = std::cbrt(extent.prod() / count);
  std::vector<Vec3> lattice;
  for (double x = box.lo[0] + step / 2; x < box.hi[0]; x += step)
    for (double y = box.lo[1] + step / 2; y < box.hi[1]; y += step)
      for (double z = box.lo[2] + step / 2; z < box.hi[2]; z += step) lattice.emplace_back(x, y, z);
  const SurfaceDistance distance(nesting.outer());
  const SurfaceRays rays(nesting.outer());
  // Two of three rays agree on it: a hole in the mesh deceives one at most.
  const auto inside = [&](const Vec3& x) {
    int out = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto hit = rays.first(x, Vec3::Unit(axis), 0, extent.norm());
      out += hit && hit->out ? 1 : 0;
    }
    return out >= 2;
  };
  std::vector<double> depth(lattice.size(), 0.0);
  parallel_for(lattice.size(), [&](std::size_t i) {
    if (inside(lattice[i])) depth[i] = distance(lattice[i], extent.norm());
  });
  std::vector<std::size_t> order(lattice.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return !(depth[i] > 0); });
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return depth[a] > depth[b]; });
  std::vector<Vec3> deep;
  for (const std::size_t i : order) deep.push_back(lattice[i]);
  return deep;
}

}  // namespace kreisel::core::nest
