#include "nest/search/placement_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace kreisel::core::nest {
namespace {

ClimbOptions seeded(ClimbOptions climb, std::uint64_t seed) {
  climb.seed = seed;
  return climb;
}

}  // namespace

PlacementSearch::PlacementSearch(PlacementObjective& objective, const PlacementSearchOptions& options)
    : objective_(objective),
      options_(options),
      swarm_(objective, options.swarm),
      climb_(objective, seeded(options.climb, options.swarm.seed)) {}

void PlacementSearch::keep(SearchState& state, const SwarmStep& step, const std::vector<double>& x,
                           double value) const {
  state.trace.push_back(step);
  if (!(value > state.scale)) return;
  state.scale = value;
  state.best = x;
}

SearchState PlacementSearch::start() const {
  SearchState state;
  SwarmStep step{};
  state.swarm = swarm_.start(&step);
  keep(state, step, state.swarm.best, state.swarm.best_value);
  state.memory = objective_.memory();
  return state;
}

void PlacementSearch::begin_climb(SearchState& state) const {
  // The particles' bests, best first; those that others have gathered at are passed over by taking every
  // tenth of the order.
  const std::vector<double>& values = state.swarm.own_value;
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  const std::size_t pick =
      static_cast<std::size_t>(state.climbs) * std::max<std::size_t>(1, order.size() / 10);
  const bool first = state.climbs == 0;
  if (state.climbs >= options_.climbs || state.best.empty() || (!first && pick >= order.size()) ||
      (!first && !(values[order[pick]] > 0))) {
    state.phase = SearchState::over;
    return;
  }
  ++state.climbs;
  if (first) {
    state.climb = climb_.start(state.best, state.scale);
  } else {
    const auto size = static_cast<std::ptrdiff_t>(objective_.space().size());
    const auto x = state.swarm.own.begin() + static_cast<std::ptrdiff_t>(order[pick]) * size;
    state.climb = climb_.start({x, x + size}, values[order[pick]]);
  }
  state.phase = SearchState::climbing;
}

bool PlacementSearch::step(SearchState& state) const {
  objective_.recall(state.memory);
  if (state.phase == SearchState::swarming) {
    if (state.swarm.iteration < options_.swarm.iterations) {
      const SwarmStep step = swarm_.step(state.swarm);
      keep(state, step, state.swarm.best, state.swarm.best_value);
    } else {
      begin_climb(state);
    }
  } else if (state.phase == SearchState::climbing) {
    const std::uint64_t before = state.climb.evaluations;
    if (climb_.step(state.climb)) {
      SwarmStep step = state.trace.back();
      ++step.iteration;
      step.evaluations += state.climb.evaluations - before;
      step.mean = state.climb.value;
      step.best = std::max(step.best, state.climb.value);
      keep(state, step, state.climb.x, state.climb.value);
    } else {
      begin_climb(state);
    }
  }
  state.memory = objective_.memory();
  return state.phase != SearchState::over;
}

void PlacementSearch::take_in(SearchState& state, const std::vector<double>& x) const {
  const bool fits = x.size() == static_cast<std::size_t>(objective_.space().size()) &&
                    std::ranges::all_of(x, [](double number) { return std::isfinite(number); });
  if (!fits || state.phase != SearchState::swarming) return;
  objective_.recall(state.memory);
  swarm_.take_in(state.swarm, x);
  state.memory = objective_.memory();
  if (!(state.swarm.best_value > state.scale)) return;
  state.scale = state.swarm.best_value;
  state.best = state.swarm.best;
}

Placement PlacementSearch::best(const SearchState& state) const {
  Placement placement = objective_.placements().placement(state.best);
  placement.pose.scale = state.scale;
  return placement;
}

}  // namespace kreisel::core::nest
