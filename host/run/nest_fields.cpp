#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "body/source.hpp"
#include "nest/search/baseline.hpp"
#include "run/nest_config.hpp"
#include "settings/field_text.hpp"
#include "words.hpp"

namespace kreisel::core {
using namespace field_text;
namespace {

using S = std::string_view;

double positive(S name, S value) {
  const double v = number(name, value);
  if (!(v > 0)) refuse(name, value, "a number > 0");
  return v;
}

double at_least_0(S name, S value) {
  const double v = number(name, value);
  if (!(v >= 0) || std::isinf(v)) refuse(name, value, "a number >= 0");
  return v;
}

int integer(S name, S value) {
  const auto v = parse<int>(value);
  if (!v) refuse(name, value, "a whole number");
  return *v;
}

Vec3 direction(S name, S value) {
  const Vec3 v = vector(name, value);
  if (!(v.norm() > 0)) refuse(name, value, "a vector that is not zero");
  return v;
}

std::pair<Vec3, Vec3> directions(S name, S value) {
  const auto words = split(value, ' ');
  if (words.size() != 2) refuse(name, value, "two directions x,y,z: of the half above and of the one below");
  return {direction(name, words[0]), direction(name, words[1])};
}

std::vector<nest::KeepOut> balls(S name, S value) {
  std::vector<nest::KeepOut> all;
  for (const std::string& text : split_words(value)) {
    const S word = text;
    const std::size_t comma = word.rfind(',');
    const auto centre = parse_vector(word.substr(0, comma));
    const auto radius = comma == S::npos ? std::nullopt : parse<double>(word.substr(comma + 1));
    if (!centre || !radius || !(*radius > 0)) refuse(name, word, "a ball x,y,z,radius");
    all.push_back({*centre, *radius});
  }
  return all;
}

std::string text_of_number(double v) { return fmt::format("{}", v); }
std::string text_of_number(int v) { return fmt::format("{}", v); }
template <class Number>
std::string text_of_number(const std::optional<Number>& v) {
  return v ? text_of_number(*v) : "";
}
std::string text_of_point(const std::optional<Vec3>& v) { return v ? text_of(*v) : ""; }

std::string text_of_balls(const std::vector<nest::KeepOut>& balls) {
  std::vector<std::string> words;
  for (const nest::KeepOut& ball : balls)
    words.push_back(fmt::format("{},{}", text_of(ball.centre), ball.radius));
  return fmt::format("{}", fmt::join(words, " "));
}

/// Of enumerators, which are counted from 0.
template <class Enum>
Choices words_until(Enum last) {
  return [last] {
    std::vector<std::string> words;
    for (int i = 0; i <= static_cast<int>(last); ++i) words.emplace_back(to_string(static_cast<Enum>(i)));
    return words;
  };
}

/// Which shapes.
Fields<NestShapes> shape_fields() {
  return grouped<NestShapes>(
      "shapes",
      {chosen_from<NestShapes>(shape_names,
                               {"outer", "", "the outer shape: a name of `bench list`, or a mesh file",
                                [](NestShapes& c, S, S v) { c.outer = v; },
                                [](const NestShapes& c) { return c.outer; }, Identity::changed, 1, true}),
       chosen_from<NestShapes>(shape_names,
                               {"inner", "", "the inner shape, named likewise; default: the outer one",
                                [](NestShapes& c, S, S v) { c.inner = v; },
                                [](const NestShapes& c) { return c.inner == c.outer ? "" : c.inner; },
                                Identity::changed, 1, true}),
       {"outer-size", "", "longest side of the outer shape; default: as its file has it",
        [](NestShapes& c, S n, S v) { c.outer_size = positive(n, v); },
        [](const NestShapes& c) { return text_of_number(c.outer_size); }},
       {"inner-size", "", "longest side of the inner shape, at scale 1; default: as its file has it",
        [](NestShapes& c, S n, S v) { c.inner_size = positive(n, v); },
        [](const NestShapes& c) { return text_of_number(c.inner_size); }},
       {"fineness", "", "n: a model of our own gets about 20 n^2 triangles",
        [](NestShapes& c, S n, S v) { c.fineness = whole(n, v, 1); },
        [](const NestShapes& c) { return text_of_number(c.fineness); }}});
}

/// What is kept, and where it is computed.
Fields<NestShapes> keeping_fields() {
  return grouped<NestShapes>(
      "device",
      {one_of<NestShapes>(
           "keep-shapes", "yes: keep the meshes in the record, for plots/nest_picture.py; default no",
           {"no", "yes"}, [](auto& c) -> auto& { return c.keep_shapes; }),
       {"device", "",
        "OpenCL device: its index, or part of its name; default: KREISEL_DEVICE, else a GPU, else PoCL on "
        "the processor",
        [](NestShapes& c, S, S v) { c.device = v; }, [](const NestShapes& c) { return c.device; },
        Identity::none}});
}

/// How the inner shape is turned, and the cut.
Fields<NestTurn> turn_fields() {
  return grouped<NestTurn>(
      "placement",
      {{"rotation", "x,y,z",
        "how the inner shape is turned: an axis times the degrees about it; default: not at all",
        [](NestTurn& c, S n, S v) { c.rotation = vector(n, v); },
        [](const NestTurn& c) { return text_of(c.rotation); }},
       {"plane", "x,y,z", "normal of the cut; default 0,0,1",
        [](NestTurn& c, S n, S v) { c.plane = direction(n, v); },
        [](const NestTurn& c) { return text_of(c.plane); }},
       {"removal", "x,y,z x,y,z",
        "directions in which the halves above and below the cut leave; default: along its normal",
        [](NestTurn& c, S n, S v) { c.removal = directions(n, v); },
        [](const NestTurn& c) {
          return c.removal ? fmt::format("{} {}", text_of(c.removal->first), text_of(c.removal->second)) : "";
        },
        Identity::changed, 2}});
}

/// Where they are.
Fields<NestPlace> place_fields() {
  return grouped<NestPlace>(
      "placement",
      {{"centroid", "x,y,z",
        "where the centroid of the inner shape goes, in outer coordinates; default: the outer's centroid",
        [](NestPlace& c, S n, S v) { c.centroid = vector(n, v); },
        [](const NestPlace& c) { return text_of_point(c.centroid); }},
       {"through", "x,y,z", "a point of the cut, in outer coordinates; default: --centroid",
        [](NestPlace& c, S n, S v) { c.through = vector(n, v); },
        [](const NestPlace& c) { return text_of_point(c.through); }}});
}

/// What decides.
Fields<NestDecision> decision_fields() {
  return grouped<NestDecision>(
      "decision", {chosen_from<NestDecision>(
                       [] { return nest::feasibility_tests(); },
                       {"variant", "", "which test decides: peel, envelope, exact or hybrid (default)",
                        [](NestDecision& c, S, S v) {
                          nest::require_test(v);
                          c.variant = v;
                        },
                        [](const NestDecision& c) { return c.variant; }}),
                   {"resolution", "", "pixels along a side of a view, for peel and envelope; default 512",
                    [](NestDecision& c, S n, S v) { c.resolution = integer(n, v); },
                    [](const NestDecision& c) { return text_of_number(c.resolution); }},
                   {"upper", "", "largest scale to look at; default: what can fit",
                    [](NestDecision& c, S n, S v) { c.upper = number(n, v); },
                    [](const NestDecision& c) { return text_of_number(c.upper); }},
                   {"tolerance", "", "how near to the largest scale the search comes; default 1e-4",
                    [](NestDecision& c, S n, S v) { c.tolerance = number(n, v); },
                    [](const NestDecision& c) { return text_of_number(c.tolerance); }}});
}

/// What is free, and how long it is searched.
Fields<NestSearch> free_fields() {
  return grouped<NestSearch>(
      "search",
      {{"free", "",
        "what a search for the largest nesting may change: rotation or upright, position, plane or "
        "centroid-plane, removal; with commas between, or all",
        [](NestSearch& c, S, S v) {
          nest::Freedom().set_free(v);
          c.free = v;
        },
        [](const NestSearch& c) { return c.free; }},
       {"up", "x,y,z", "what an upright inner shape turns about; default 0,0,1",
        [](NestSearch& c, S n, S v) { c.up = direction(n, v); },
        [](const NestSearch& c) { return text_of(c.up); }},
       {"keep-out", "x,y,z,radius ...",
        "balls x,y,z,radius in outer coordinates, in which the cut does not touch the surface",
        [](NestSearch& c, S n, S v) { c.keep_outs = balls(n, v); },
        [](const NestSearch& c) { return text_of_balls(c.keep_outs); }, Identity::changed, 0},
       {"seconds", "s", "end the search after this time, with the best so far; default: never",
        [](NestSearch& c, S n, S v) { c.seconds = positive(n, v); },
        [](const NestSearch& c) { return std::isinf(c.seconds) ? "" : text_of_number(c.seconds); }}});
}

/// How a swarm moves.
Fields<NestSearch> swarm_fields() {
  return grouped<NestSearch>(
      "swarm",
      {chosen_from<NestSearch>(words_of(nest::variants()),
                               {"swarm", "", "kind of swarm: basic, hybrid or hybrid+abort (default)",
                                [](NestSearch& c, S, S v) {
                                  if (nest::is_baseline(v))
                                    (void)nest::find_baseline(v);
                                  else
                                    nest::require_variant(v);
                                  c.swarm = v;
                                },
                                [](const NestSearch& c) { return c.swarm; }}),
       {"particles", "", "how many particles, of all swarms together; default 200",
        [](NestSearch& c, S n, S v) { c.search.swarm.particles = integer(n, v); },
        [](const NestSearch& c) { return text_of_number(c.search.swarm.particles); }},
       {"iterations", "", "how many iterations of the swarm; default 150",
        [](NestSearch& c, S n, S v) { c.search.swarm.iterations = integer(n, v); },
        [](const NestSearch& c) { return text_of_number(c.search.swarm.iterations); }},
       {"seed", "", "seed of the random numbers; default 1",
        [](NestSearch& c, S n, S v) {
          const auto seed = parse<std::uint64_t>(v);
          if (!seed) refuse(n, v, "a whole number >= 0");
          c.search.swarm.seed = *seed;
        },
        [](const NestSearch& c) { return fmt::format("{}", c.search.swarm.seed); }},
       chosen_from<NestSearch>(
           words_until(nest::Topology::random),
           {"topology", "", "whose best draws a particle: global, ring, von-neumann (default) or random",
            [](NestSearch& c, S, S v) { c.search.swarm.topology = nest::parse_topology(v); },
            [](const NestSearch& c) { return std::string(to_string(c.search.swarm.topology)); }}),
       chosen_from<NestSearch>(
           words_until(nest::Momentum::constriction),
           {"momentum", "", "how particles keep their speed: constant, decreasing or constriction (default)",
            [](NestSearch& c, S, S v) { c.search.swarm.momentum = nest::parse_momentum(v); },
            [](const NestSearch& c) { return std::string(to_string(c.search.swarm.momentum)); }}),
       {"inertia", "",
        "share of its velocity that a particle keeps, at constant or decreasing momentum; default 0.98",
        [](NestSearch& c, S n, S v) { c.search.swarm.inertia = number(n, v); },
        [](const NestSearch& c) { return text_of_number(c.search.swarm.inertia); }},
       {"last-inertia", "", "where a decreasing inertia ends; default 0.4",
        [](NestSearch& c, S n, S v) { c.search.swarm.last_inertia = number(n, v); },
        [](const NestSearch& c) { return text_of_number(c.search.swarm.last_inertia); }},
       {"own", "", "pull of a particle's own best, except with constriction; default 0.01",
        [](NestSearch& c, S n, S v) { c.search.swarm.own = number(n, v); },
        [](const NestSearch& c) { return text_of_number(c.search.swarm.own); }},
       {"social", "", "pull of its neighbours' best, except with constriction; default 0.01",
        [](NestSearch& c, S n, S v) { c.search.swarm.social = number(n, v); },
        [](const NestSearch& c) { return text_of_number(c.search.swarm.social); }}});
}

/// How a search begins, climbs and ends.
Fields<NestSearch> climb_fields() {
  return grouped<NestSearch>(
      "swarm",
      {chosen_from<NestSearch>(
           words_until(nest::Placing::lattice),
           {"placing", "",
            "first positions: lattice (default) or random, deep inside the outer shape; or anywhere in its "
            "box",
            [](NestSearch& c, S, S v) { c.search.swarm.placing = nest::parse_placing(v); },
            [](const NestSearch& c) { return std::string(to_string(c.search.swarm.placing)); }}),
       {"first-speed", "", "first velocities, as a part of the way to another position; default 0.5",
        [](NestSearch& c, S n, S v) { c.search.swarm.first_speed = number(n, v); },
        [](const NestSearch& c) { return text_of_number(c.search.swarm.first_speed); }},
       {"candidates", "", "positions that a particle tries before it starts from the best; default 1",
        [](NestSearch& c, S n, S v) { c.search.swarm.candidates = integer(n, v); },
        [](const NestSearch& c) { return text_of_number(c.search.swarm.candidates); }},
       {"swarms", "", "how many swarms, which know nothing of each other; default 1",
        [](NestSearch& c, S n, S v) { c.search.swarm.swarms = integer(n, v); },
        [](const NestSearch& c) { return text_of_number(c.search.swarm.swarms); }},
       {"patience", "", "a swarm starts anew after so many iterations without a rise; default 0: never",
        [](NestSearch& c, S n, S v) { c.search.swarm.patience = integer(n, v); },
        [](const NestSearch& c) { return text_of_number(c.search.swarm.patience); }},
       {"climbs", "", "final refinements, from the best positions of different particles; default 1",
        [](NestSearch& c, S n, S v) { c.search.climbs = whole(n, v, 0); },
        [](const NestSearch& c) { return text_of_number(c.search.climbs); }},
       {"climb-iterations", "", "most iterations of a refinement; default 300",
        [](NestSearch& c, S n, S v) { c.search.climb.iterations = integer(n, v); },
        [](const NestSearch& c) { return text_of_number(c.search.climb.iterations); }},
       {"climb-step", "",
        "first standard deviation of a refinement, radians or parts of ranges; default 0.05",
        [](NestSearch& c, S n, S v) { c.search.climb.first_step = positive(n, v); },
        [](const NestSearch& c) { return text_of_number(c.search.climb.first_step); }}});
}

/// Of what has a placement to time every variant at.
template <class T>
Fields<T> timing_fields() {
  return grouped<T>(
      "decision",
      {{"timings", "", "time every variant at the placement found, with so many repetitions; default: none",
        [](T& c, S n, S v) { c.timings = whole(n, v, 0); },
        [](const T& c) { return text_of_number(c.timings); }}});
}

/// Of swarms that run beside each other.
Fields<NestSwarm> island_fields() {
  return grouped<NestSwarm>(
      "swarm", {{"exchange", "",
                 "swarms of other seeds hear of each other's best after so many iterations; default 0: never",
                 [](NestSwarm& c, S n, S v) { c.exchange = whole(n, v, 0); },
                 [](const NestSwarm& c) { return text_of_number(c.exchange); }}});
}

Fields<NestTest> test_fields() {
  return grouped<NestTest>(
      "placement", {{"scale", "", "test this scale of the inner shape; default: search for the largest",
                     [](NestTest& c, S n, S v) { c.scale = number(n, v); },
                     [](const NestTest& c) { return text_of_number(c.scale); }}});
}

/// Shapes in shapes in shapes.
Fields<NestLayers> layer_fields() {
  return grouped<NestLayers>(
      "layers", {{"layers", "",
                  "how often to put a shape into the one outside it, unless nothing fits before; with --free",
                  [](NestLayers& c, S n, S v) { c.layers = whole(n, v, 1); },
                  [](const NestLayers& c) { return text_of_number(c.layers); }},
                 chosen_from<NestLayers>(
                     shape_names, {"within", "", "layers: shapes inside the inner one, the outermost first",
                                   [](NestLayers& c, S, S v) { c.within = split_words(v); },
                                   [](const NestLayers& c) { return joined_words(c.within); },
                                   Identity::changed, 0, true}),
                 {"printer-accuracy", "mm", "layers: how far a printed surface may be off; default 0",
                  [](NestLayers& c, S n, S v) { c.tolerances.accuracy = at_least_0(n, v); },
                  [](const NestLayers& c) { return text_of_number(c.tolerances.accuracy); }},
                 {"wall", "mm", "layers: least thickness of material that is left; default 0",
                  [](NestLayers& c, S n, S v) { c.tolerances.wall = at_least_0(n, v); },
                  [](const NestLayers& c) { return text_of_number(c.tolerances.wall); }},
                 {"cells", "", "layers: voxels along the longest side of what is offset; default 192",
                  [](NestLayers& c, S n, S v) { c.cells = whole(n, v, 8); },
                  [](const NestLayers& c) { return text_of_number(c.cells); }}});
}

Fields<NestAccuracy> accuracy_fields() {
  return grouped<NestAccuracy>(
      "accuracy", {{"accuracy", "", "compare the variants over this many random placements instead",
                    [](NestAccuracy& c, S n, S v) { c.accuracy = whole(n, v, 1); },
                    [](const NestAccuracy& c) { return text_of_number(c.accuracy); }},
                   {"seed", "", "seed of the random numbers; default 1",
                    [](NestAccuracy& c, S n, S v) {
                      const auto seed = parse<std::uint64_t>(v);
                      if (!seed) refuse(n, v, "a whole number >= 0");
                      c.seed = *seed;
                    },
                    [](const NestAccuracy& c) { return fmt::format("{}", c.seed); }}});
}

/// A map of how large the outlines nest.
Fields<NestOutlines> outline_fields() {
  return grouped<NestOutlines>(
      "landscape",
      {{"landscape", "",
        "map how large the shapes' outlines nest, over all rotations, with this many centroids along the "
        "longer side",
        [](NestOutlines& c, S n, S v) { c.landscape = whole(n, v, 1); },
        [](const NestOutlines& c) { return text_of_number(c.landscape); }},
       {"rotations", "", "rotations at each centroid of a landscape; default 4096",
        [](NestOutlines& c, S n, S v) { c.rotations = whole(n, v, 1); },
        [](const NestOutlines& c) { return text_of_number(c.rotations); }},
       {"view", "x,y,z", "landscape: direction from the shapes to the eye, with --up upwards; default 0,-1,0",
        [](NestOutlines& c, S n, S v) { c.view = direction(n, v); },
        [](const NestOutlines& c) { return text_of(c.view); }},
       {"up", "x,y,z", "what an upright inner shape turns about; default 0,0,1",
        [](NestOutlines& c, S n, S v) { c.up = direction(n, v); },
        [](const NestOutlines& c) { return text_of(c.up); }},
       {"tolerance", "", "how near to the largest scale the search comes; default 1e-4",
        [](NestOutlines& c, S n, S v) { c.tolerance = number(n, v); },
        [](const NestOutlines& c) { return text_of_number(c.tolerance); }}});
}

/// The fields of a kind with those that all kinds have.
template <class Kind>
NestKindEntry entry(S name, S what, S help, S by, const Fields<Kind>& own) {
  const auto kind = fields_of_part<NestConfig>(
      own, [](auto& config) -> auto& { return std::get<Kind>(config.kind); });
  return {name, what, help, by, Kind(), joined<NestConfig>(shape_fields(), kind, keeping_fields())};
}

std::vector<NestKindEntry> make_kinds() {
  const S by_nothing;  // what is left when no field says more
  return {
      entry<NestScale>(
          "scale", "a search of the scale", "up to which scale does a shape nest at one placement",
          by_nothing,
          joined<NestScale>(turn_fields(), place_fields(), decision_fields(), timing_fields<NestScale>())),
      entry<NestTest>("test", "a test of one scale", "does a shape nest at one placement and scale", "scale",
                      joined<NestTest>(test_fields(), turn_fields(), place_fields(), decision_fields(),
                                       timing_fields<NestTest>())),
      entry<NestSwarm>(
          "swarm", "a search over placements", "where does a shape nest largest", "free",
          joined<NestSwarm>(turn_fields(), place_fields(), decision_fields(), free_fields(), swarm_fields(),
                            climb_fields(), island_fields(), timing_fields<NestSwarm>())),
      entry<NestLayers>("layers", "a nesting of layers", "shapes in shapes, with walls between them",
                        "layers",
                        joined<NestLayers>(layer_fields(), turn_fields(), decision_fields(), free_fields(),
                                           swarm_fields(), climb_fields())),
      entry<NestAccuracy>("accuracy", "a comparison of variants",
                          "how far sampled scales are from exact ones, over random placements", "accuracy",
                          accuracy_fields()),
      entry<NestOutlines>("landscape", "a landscape of outlines",
                          "how large the shapes' outlines nest, wherever they are put", "landscape",
                          outline_fields()),
  };
}

}  // namespace

NestSearch::NestSearch() {
  search.swarm.topology = nest::Topology::von_neumann;
  search.swarm.momentum = nest::Momentum::constriction;
  search.swarm.iterations = 150;
}

const std::vector<NestKindEntry>& nest_kinds() {
  static const std::vector<NestKindEntry> all = make_kinds();
  return all;
}

}  // namespace kreisel::core
