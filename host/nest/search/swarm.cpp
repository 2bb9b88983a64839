#include "nest/search/swarm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "error.hpp"
#include "nest/decide/random.hpp"
#include "unknown_name.hpp"

namespace kreisel::core::nest {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

template <class Value>
using Named = std::pair<std::string_view, Value>;

constexpr std::array topologies{
    Named<Topology>{"global", Topology::global}, Named<Topology>{"ring", Topology::ring},
    Named<Topology>{"von-neumann", Topology::von_neumann}, Named<Topology>{"random", Topology::random}};
constexpr std::array momenta{Named<Momentum>{"constant", Momentum::constant},
                             Named<Momentum>{"decreasing", Momentum::decreasing},
                             Named<Momentum>{"constriction", Momentum::constriction}};
constexpr std::array placings{Named<Placing>{"random", Placing::random},
                              Named<Placing>{"anywhere", Placing::anywhere},
                              Named<Placing>{"lattice", Placing::lattice}};

template <class Names>
auto by_name(std::string_view what, const Names& names, std::string_view text) {
  std::vector<std::string_view> all;
  for (const auto& [name, value] : names) {
    if (name == text) return value;
    all.push_back(name);
  }
  throw unknown_name(what, text, all);
}

template <class Names, class Value>
std::string_view name_of(const Names& names, Value value) {
  return std::ranges::find(names, value, &Named<Value>::second)->first;
}

/// Streams of random numbers, so that no two uses share one.
enum Stream : std::uint64_t { shift_of_lattice, positions, speeds, own_pull, social_pull, informants };

}  // namespace

Topology parse_topology(std::string_view text) { return by_name("topology", topologies, text); }
Momentum parse_momentum(std::string_view text) { return by_name("momentum", momenta, text); }
Placing parse_placing(std::string_view text) { return by_name("placing", placings, text); }
std::string_view to_string(Topology topology) { return name_of(topologies, topology); }
std::string_view to_string(Momentum momentum) { return name_of(momenta, momentum); }
std::string_view to_string(Placing placing) { return name_of(placings, placing); }

std::optional<std::string> SwarmOptions::invalid() const {
  const auto wrong = [](std::string_view name, auto value, std::string_view expected) {
    return fmt::format("{} = {}; expected {}", name, value, expected);
  };
  if (particles < 1) return wrong("particles", particles, "at least one");
  if (iterations < 0) return wrong("iterations", iterations, "none or more");
  if (candidates < 1) return wrong("candidates", candidates, "at least one");
  if (swarms < 1 || swarms > particles) return wrong("swarms", swarms, "from one to as many as particles");
  if (patience < 0) return wrong("patience", patience, "a number of iterations, or 0 for never");
  for (const auto& [name, value] : {Named<double>{"inertia", inertia}, {"last-inertia", last_inertia}})
    if (!(value >= 0 && value <= 1)) return wrong(name, value, "a number in [0, 1]");
  for (const auto& [name, value] :
       {Named<double>{"own", own}, {"social", social}, {"first-speed", first_speed}, {"rise", rise}})
    if (!(value >= 0 && std::isfinite(value))) return wrong(name, value, "a number >= 0");
  return std::nullopt;
}

Swarm::Swarm(Objective& objective, const SwarmOptions& options)
    : objective_(objective),
      options_(options),
      size_(objective.space().size()),
      freedom_(objective.space().freedom()) {
  if (const auto what = options_.invalid()) throw InputError("swarm: " + *what);
}

double Swarm::number(std::uint64_t stream, int iteration, int particle, int k) const {
  const auto index = static_cast<std::uint64_t>(particle) * 64 + static_cast<std::uint64_t>(k);
  return uniform(options_.seed, stream, static_cast<std::uint64_t>(iteration), index);
}

int Swarm::first_of(int swarm) const {
  return static_cast<int>(static_cast<long long>(swarm) * options_.particles / options_.swarms);
}

Swarm::Pull Swarm::pull(int iteration) const {
  switch (options_.momentum) {
    case Momentum::constriction:
      return {0.7298, 1.4962, 1.4962};
    case Momentum::decreasing: {
      const double passed = options_.iterations > 1 ? (iteration - 1.0) / (options_.iterations - 1.0) : 0;
      return {options_.inertia + std::min(passed, 1.0) * (options_.last_inertia - options_.inertia),
              options_.own, options_.social};
    }
    case Momentum::constant:
      break;
  }
  return {options_.inertia, options_.own, options_.social};
}

int Swarm::neighbourhood_best(const SwarmState& state, int swarm, int particle) const {
  const int first = first_of(swarm), n = first_of(swarm + 1) - first, i = particle - first;
  int best = particle;
  const auto compare = [&](int other) {
    const int j = first + (other % n + n) % n;
    if (state.own_value[static_cast<std::size_t>(j)] > state.own_value[static_cast<std::size_t>(best)])
      best = j;
  };
  switch (options_.topology) {
    case Topology::global:
      for (int j = 0; j < n; ++j) compare(j);
      break;
    case Topology::ring:
      compare(i - 1);
      compare(i + 1);
      break;
    case Topology::von_neumann: {
      // Rows of a torus; where the last one is short, its columns are joined past the end.
      const int columns = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(n))));
      for (const int step : {-1, 1, -columns, columns}) compare(i + step);
      break;
    }
    case Topology::random: {
      // Three on average, drawn again when the swarm's best has not risen. [Clerc 2012, Standard PSO 2011]
      constexpr int informed = 3;
      const int epoch = state.drawn[static_cast<std::size_t>(swarm)];
      for (int k = 0; k < informed; ++k)
        compare(static_cast<int>(number(informants, epoch, particle, k) * n));
      break;
    }
  }
  return best;
}

void Swarm::place(SwarmState& state, int swarm) const {
  // The d-dimensional golden ratio, the root of r^(d+1) = r + 1.
  double ratio = 2;
  for (int k = 0; k < 40; ++k) ratio = std::pow(1 + ratio, 1.0 / (freedom_ + 1));
  std::vector<double> unit(static_cast<std::size_t>(freedom_)), other(static_cast<std::size_t>(size_));
  const auto size = static_cast<std::size_t>(size_), s = static_cast<std::size_t>(swarm);
  const int epoch = state.iteration - state.placed[s];  // one lattice for all candidates of a start
  for (int i = first_of(swarm); i < first_of(swarm + 1); ++i) {
    const auto p = static_cast<std::size_t>(i);
    const std::span<double> x(state.x.data() + p * size, size), v(state.v.data() + p * size, size);
    const int point = i + state.placed[s] * options_.particles;
    double step = 1;
    for (int k = 0; k < freedom_; ++k) {
      step /= ratio;
      const double u = options_.placing == Placing::lattice
                           ? number(shift_of_lattice, epoch, 0, k) + step * (point + 1)
                           : number(positions, state.iteration, i, k);
      unit[static_cast<std::size_t>(k)] = u - std::floor(u);
    }
    objective_.place(unit, x);
    objective_.project(x);
    for (int k = 0; k < freedom_; ++k)
      unit[static_cast<std::size_t>(k)] = number(speeds, state.iteration, i, k);
    objective_.place(unit, other);
    objective_.space().towards(x, other, v);
    for (double& component : v) component *= options_.first_speed;
    if (state.placed[s] > 0) continue;
    std::ranges::copy(x, state.own.begin() + static_cast<std::ptrdiff_t>(p * size));
    state.own_value[p] = nothing;
  }
  if (state.placed[s] == 0) state.top[s] = nothing;
  state.rose[s] = state.iteration;
  ++state.placed[s];
}

SwarmStep Swarm::ask(SwarmState& state) const {
  const std::vector<double> values = objective_.values(state.x, state.own_value);
  const auto size = static_cast<std::ptrdiff_t>(size_);
  SwarmStep step{state.iteration, 0, 0, 0, 0};
  for (int swarm = 0; swarm < options_.swarms; ++swarm) {
    const auto s = static_cast<std::size_t>(swarm);
    double& top = state.top[s];
    const double before = top;
    for (int i = first_of(swarm); i < first_of(swarm + 1); ++i) {
      const auto p = static_cast<std::size_t>(i);
      if (values[p] > nothing) step.feasible += 1.0 / options_.particles;
      if (!(values[p] > state.own_value[p])) continue;
      state.own_value[p] = values[p];
      const auto x = state.x.begin() + i * size;
      std::copy(x, x + size, state.own.begin() + i * size);
      top = std::max(top, values[p]);
      if (values[p] > state.best_value) {
        state.best_value = values[p];
        state.best.assign(x, x + size);
      }
    }
    const bool rises = before == nothing ? top > nothing : top > before + options_.rise * std::abs(before);
    (rises ? state.rose : state.drawn)[s] = state.iteration;
  }
  state.evaluations += values.size();
  double sum = 0, count = 0;
  for (const double own : state.own_value)
    if (own > nothing) sum += own, ++count;
  step.mean = count > 0 ? sum / count : nothing;
  step.best = state.best_value;
  step.evaluations = state.evaluations;
  return step;
}

void Swarm::take_in(SwarmState& state, const std::vector<double>& x) const {
  const auto worst = std::ranges::min_element(state.own_value);
  const double value = objective_.values(x, std::array{nothing}).front();
  ++state.evaluations;
  if (!(value > *worst)) return;
  const auto particle = static_cast<int>(worst - state.own_value.begin());
  *worst = value;
  const auto at = static_cast<std::ptrdiff_t>(particle) * size_;
  std::ranges::copy(x, state.x.begin() + at);
  std::ranges::copy(x, state.own.begin() + at);
  int swarm = 0;
  while (first_of(swarm + 1) <= particle) ++swarm;
  double& top = state.top[static_cast<std::size_t>(swarm)];
  top = std::max(top, value);
  if (!(value > state.best_value)) return;
  state.best_value = value;
  state.best = x;
}

SwarmState Swarm::start(SwarmStep* step) const {
  const auto n = static_cast<std::size_t>(options_.particles), size = static_cast<std::size_t>(size_);
  SwarmState state;
  state.x.resize(n * size);
  state.v.resize(n * size);
  state.own.resize(n * size);
  state.own_value.resize(n);
  for (auto* iterations : {&state.rose, &state.drawn, &state.placed})
    iterations->resize(static_cast<std::size_t>(options_.swarms));
  state.top.resize(static_cast<std::size_t>(options_.swarms));
  for (int swarm = 0; swarm < options_.swarms; ++swarm) place(state, swarm);
  const SwarmStep first = ask(state);
  if (step) *step = first;
  return state;
}

SwarmStep Swarm::step(SwarmState& state) const {
  const auto size = static_cast<std::size_t>(size_);
  std::vector<double> to_own(size), to_other(size);
  // All are drawn by the bests before this iteration.
  std::vector<int> drawn_to(static_cast<std::size_t>(options_.particles));
  for (int swarm = 0; swarm < options_.swarms; ++swarm)
    for (int i = first_of(swarm); i < first_of(swarm + 1); ++i)
      drawn_to[static_cast<std::size_t>(i)] = neighbourhood_best(state, swarm, i);
  ++state.iteration;
  const Pull pull = this->pull(state.iteration);
  for (int swarm = 0; swarm < options_.swarms; ++swarm) {
    const auto s = static_cast<std::size_t>(swarm);
    if (options_.patience > 0 && state.iteration - state.rose[s] > options_.patience) state.placed[s] = 0;
    if (state.placed[s] < options_.candidates) {
      place(state, swarm);
      continue;
    }
    if (state.placed[s] == options_.candidates) {
      const auto begin = first_of(swarm) * static_cast<std::ptrdiff_t>(size_);
      std::copy(state.own.begin() + begin, state.own.begin() + first_of(swarm + 1) * size_,
                state.x.begin() + begin);
      ++state.placed[s];
    }
    for (int i = first_of(swarm); i < first_of(swarm + 1); ++i) {
      const auto p = static_cast<std::size_t>(i), g = static_cast<std::size_t>(drawn_to[p]);
      const std::span<double> x(state.x.data() + p * size, size), v(state.v.data() + p * size, size);
      objective_.space().towards(x, std::span<const double>(state.own.data() + p * size, size), to_own);
      objective_.space().towards(x, std::span<const double>(state.own.data() + g * size, size), to_other);
      for (std::size_t k = 0; k < size; ++k) {
        const int number_of = static_cast<int>(k);
        v[k] = pull.keep * v[k] + pull.own * number(own_pull, state.iteration, i, number_of) * to_own[k] +
               pull.social * number(social_pull, state.iteration, i, number_of) * to_other[k];
        x[k] += v[k];
      }
      objective_.project(x);
    }
  }
  return ask(state);
}

}  // namespace kreisel::core::nest
