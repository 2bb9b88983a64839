#include "run/nest_config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "nest/search/baseline.hpp"
#include "session/field_text.hpp"
#include "unknown_name.hpp"

namespace kreisel::core {
using namespace field_text;
namespace {

using C = NestConfig&;
using Const = const NestConfig&;
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
  for (const S word : split(value, ' ')) {
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

/// Which shapes, and how they lie.
std::vector<NestField> placement_fields() {
  return {
      {"outer", "the shape outside: a name of `bench list`, or a mesh file", 1,
       [](C c, S, S v) { c.outer = v; }, [](Const c) { return c.outer; }},
      {"inner", "the shape inside; default the outer one", 1, [](C c, S, S v) { c.inner = v; },
       [](Const c) { return c.inner == c.outer ? "" : c.inner; }},
      {"outer-size", "longest side of the outer shape; default as its file has it", 1,
       [](C c, S n, S v) { c.outer_size = positive(n, v); },
       [](Const c) { return text_of_number(c.outer_size); }},
      {"inner-size", "longest side of the inner shape, which scales count from; default as its file has it",
       1, [](C c, S n, S v) { c.inner_size = positive(n, v); },
       [](Const c) { return text_of_number(c.inner_size); }},
      {"fineness", "of a parametric model: about 20 n^2 triangles", 1,
       [](C c, S n, S v) { c.fineness = whole(n, v, 1); },
       [](Const c) { return text_of_number(c.fineness); }},
      {"scale", "test this scale of the inner shape; default: search for the largest", 1,
       [](C c, S n, S v) { c.scale = number(n, v); }, [](Const c) { return text_of_number(c.scale); }},
      {"rotation", "of the inner shape: axis times degrees, x,y,z; default none", 1,
       [](C c, S n, S v) { c.rotation = vector(n, v); }, [](Const c) { return text_of(c.rotation); }},
      {"centroid", "where the inner shape's centroid goes, outer coordinates; default the outer's", 1,
       [](C c, S n, S v) { c.centroid = vector(n, v); }, [](Const c) { return text_of_point(c.centroid); }},
      {"plane", "normal of the cut, x,y,z; default 0,0,1", 1,
       [](C c, S n, S v) { c.plane = direction(n, v); }, [](Const c) { return text_of(c.plane); }},
      {"through", "a point of the cut, outer coordinates; default --centroid", 1,
       [](C c, S n, S v) { c.through = vector(n, v); }, [](Const c) { return text_of_point(c.through); }},
      {"removal", "directions in which the halves above and below leave; default along the normal", 2,
       [](C c, S n, S v) { c.removal = directions(n, v); },
       [](Const c) {
         return c.removal ? fmt::format("{} {}", text_of(c.removal->first), text_of(c.removal->second)) : "";
       }},
  };
}

/// What decides, and what is free.
std::vector<NestField> test_fields() {
  return {
      {"variant", "what decides: peel, envelope, exact or hybrid (default)", 1,
       [](C c, S, S v) {
         nest::require_test(v);
         c.variant = v;
       },
       [](Const c) { return c.variant; }},
      {"resolution", "pixels along a side of a view of peel and envelope; default 512", 1,
       [](C c, S n, S v) { c.resolution = integer(n, v); },
       [](Const c) { return text_of_number(c.resolution); }},
      {"upper", "largest scale to look at; default what can fit", 1,
       [](C c, S n, S v) { c.upper = number(n, v); }, [](Const c) { return text_of_number(c.upper); }},
      {"tolerance", "of the scale that is searched; default 1e-4", 1,
       [](C c, S n, S v) { c.tolerance = number(n, v); },
       [](Const c) { return text_of_number(c.tolerance); }},
      {"free",
       "look for the largest nesting over: rotation or upright, position, plane or centroid-plane, removal; "
       "a "
       "list with commas, or all",
       1,
       [](C c, S, S v) {
         nest::Freedom().set_free(v);
         c.free = v;
       },
       [](Const c) { return c.free; }},
      {"up", "what an upright inner shape turns about; default 0,0,1", 1,
       [](C c, S n, S v) { c.up = direction(n, v); }, [](Const c) { return text_of(c.up); }},
      {"keep-out", "balls x,y,z,radius, outer coordinates: the cut does not touch the surface in them", 0,
       [](C c, S n, S v) { c.keep_outs = balls(n, v); }, [](Const c) { return text_of_balls(c.keep_outs); }},
  };
}

/// How a swarm moves.
std::vector<NestField> swarm_fields() {
  return {
      {"swarm", "basic, hybrid or hybrid+abort (default)", 1,
       [](C c, S, S v) {
         if (nest::is_baseline(v))
           (void)nest::find_baseline(v);
         else
           nest::require_variant(v);
         c.swarm = v;
       },
       [](Const c) { return c.swarm; }},
      {"particles", "of all swarms together; default 200", 1,
       [](C c, S n, S v) { c.search.swarm.particles = integer(n, v); },
       [](Const c) { return text_of_number(c.search.swarm.particles); }},
      {"iterations", "of the swarm; default 150", 1,
       [](C c, S n, S v) { c.search.swarm.iterations = integer(n, v); },
       [](Const c) { return text_of_number(c.search.swarm.iterations); }},
      {"seed", "of a swarm, and of random placements; default 1", 1,
       [](C c, S n, S v) {
         const auto seed = parse<std::uint64_t>(v);
         if (!seed) refuse(n, v, "a whole number >= 0");
         c.search.swarm.seed = *seed;
       },
       [](Const c) { return fmt::format("{}", c.search.swarm.seed); }},
      {"topology", "whose best draws a particle: global, ring, von-neumann (default) or random", 1,
       [](C c, S, S v) { c.search.swarm.topology = nest::parse_topology(v); },
       [](Const c) { return std::string(to_string(c.search.swarm.topology)); }},
      {"momentum", "of particles: constant, decreasing or constriction (default)", 1,
       [](C c, S, S v) { c.search.swarm.momentum = nest::parse_momentum(v); },
       [](Const c) { return std::string(to_string(c.search.swarm.momentum)); }},
      {"inertia",
       "part of its velocity that a particle keeps at constant or decreasing momentum; default 0.98", 1,
       [](C c, S n, S v) { c.search.swarm.inertia = number(n, v); },
       [](Const c) { return text_of_number(c.search.swarm.inertia); }},
      {"last-inertia", "what a decreasing inertia ends at; default 0.4", 1,
       [](C c, S n, S v) { c.search.swarm.last_inertia = number(n, v); },
       [](Const c) { return text_of_number(c.search.swarm.last_inertia); }},
      {"own", "pull of a particle's own best, but with constriction; default 0.01", 1,
       [](C c, S n, S v) { c.search.swarm.own = number(n, v); },
       [](Const c) { return text_of_number(c.search.swarm.own); }},
      {"social", "pull of its neighbours' best, but with constriction; default 0.01", 1,
       [](C c, S n, S v) { c.search.swarm.social = number(n, v); },
       [](Const c) { return text_of_number(c.search.swarm.social); }},
  };
}

/// How a search begins, climbs and ends.
std::vector<NestField> search_fields() {
  return {
      {"placing",
       "first positions: lattice (default) or random, deep inside the outer shape; or anywhere in its box", 1,
       [](C c, S, S v) { c.search.swarm.placing = nest::parse_placing(v); },
       [](Const c) { return std::string(to_string(c.search.swarm.placing)); }},
      {"first-speed", "first velocities, as a part of the way to another position; default 0.5", 1,
       [](C c, S n, S v) { c.search.swarm.first_speed = number(n, v); },
       [](Const c) { return text_of_number(c.search.swarm.first_speed); }},
      {"candidates", "positions that a particle tries before it starts from the best; default 1", 1,
       [](C c, S n, S v) { c.search.swarm.candidates = integer(n, v); },
       [](Const c) { return text_of_number(c.search.swarm.candidates); }},
      {"swarms", "that know nothing of each other; default 1", 1,
       [](C c, S n, S v) { c.search.swarm.swarms = integer(n, v); },
       [](Const c) { return text_of_number(c.search.swarm.swarms); }},
      {"patience", "iterations without a rise after which a swarm starts anew; default 0, never", 1,
       [](C c, S n, S v) { c.search.swarm.patience = integer(n, v); },
       [](Const c) { return text_of_number(c.search.swarm.patience); }},
      {"climbs", "final refinements, from the best positions of different particles; default 1", 1,
       [](C c, S n, S v) { c.search.climbs = whole(n, v, 0); },
       [](Const c) { return text_of_number(c.search.climbs); }},
      {"climb-iterations", "of a refinement at most; default 300", 1,
       [](C c, S n, S v) { c.search.climb.iterations = integer(n, v); },
       [](Const c) { return text_of_number(c.search.climb.iterations); }},
      {"climb-step", "first standard deviation of a refinement, radians or parts of ranges; default 0.05", 1,
       [](C c, S n, S v) { c.search.climb.first_step = positive(n, v); },
       [](Const c) { return text_of_number(c.search.climb.first_step); }},
  };
}

/// Other answers than one nesting, and what is kept.
std::vector<NestField> kind_fields() {
  return {
      {"seconds", "after which the search ends, with the best so far; default never", 1,
       [](C c, S n, S v) { c.seconds = positive(n, v); },
       [](Const c) { return std::isinf(c.seconds) ? "" : text_of_number(c.seconds); }},
      {"accuracy", "compare the variants over this many random placements instead", 1,
       [](C c, S n, S v) { c.accuracy = whole(n, v, 1); },
       [](Const c) { return text_of_number(c.accuracy); }},
      {"timings", "repetitions by which every variant is timed at the placement found; default none", 1,
       [](C c, S n, S v) { c.timings = whole(n, v, 0); }, [](Const c) { return text_of_number(c.timings); }},
      {"layers", "put a shape into the one outside it this often, or until nothing fits; with --free", 1,
       [](C c, S n, S v) { c.layers = whole(n, v, 1); }, [](Const c) { return text_of_number(c.layers); }},
      {"within", "of layers: shapes inside the inner one, the outermost first", 0,
       [](C c, S, S v) {
         c.within.clear();
         for (const S word : split(v, ' ')) c.within.emplace_back(word);
       },
       [](Const c) { return fmt::format("{}", fmt::join(c.within, " ")); }},
      {"printer-accuracy", "of layers: how far a printed surface may be off, mm; default 0", 1,
       [](C c, S n, S v) { c.tolerances.accuracy = at_least_0(n, v); },
       [](Const c) { return text_of_number(c.tolerances.accuracy); }},
      {"wall", "of layers: least thickness that is left, mm; default 0", 1,
       [](C c, S n, S v) { c.tolerances.wall = at_least_0(n, v); },
       [](Const c) { return text_of_number(c.tolerances.wall); }},
      {"cells", "of layers: voxels along the longest side of what is offset; default 192", 1,
       [](C c, S n, S v) { c.cells = whole(n, v, 8); }, [](Const c) { return text_of_number(c.cells); }},
      {"landscape",
       "map how large the shapes' outlines nest, over all rotations, with this many centroids along the "
       "longer "
       "side",
       1, [](C c, S n, S v) { c.landscape = whole(n, v, 1); },
       [](Const c) { return text_of_number(c.landscape); }},
      {"rotations", "of a landscape; default 4096", 1, [](C c, S n, S v) { c.rotations = whole(n, v, 1); },
       [](Const c) { return text_of_number(c.rotations); }},
      {"view", "of a landscape: from the shapes to the eye, --up upwards; default 0,-1,0", 1,
       [](C c, S n, S v) { c.view = direction(n, v); }, [](Const c) { return text_of(c.view); }},
      {"keep-shapes", "yes: the record holds the meshes, for plots/nest_picture.py; default no", 1,
       [](C c, S n, S v) {
         if (v != "yes" && v != "no") refuse(n, v, "yes or no");
         c.keep_shapes = v == "yes";
       },
       [](Const c) { return std::string(c.keep_shapes ? "yes" : "no"); }},
      {"device", "index or part of a name; default KREISEL_DEVICE, else a GPU, else PoCL", 1,
       [](C c, S, S v) { c.device = v; }, [](Const c) { return c.device; }},
  };
}

std::vector<NestField> make_fields() {
  std::vector<NestField> all;
  for (std::vector<NestField> group :
       {placement_fields(), test_fields(), swarm_fields(), search_fields(), kind_fields()})
    std::ranges::move(group, std::back_inserter(all));
  return all;
}

std::string stem(const std::string& model) { return std::filesystem::path(model).stem().string(); }

}  // namespace

NestConfig::NestConfig() {
  search.swarm.topology = nest::Topology::von_neumann;
  search.swarm.momentum = nest::Momentum::constriction;
  search.swarm.iterations = 150;
}

const std::vector<NestField>& nest_fields() {
  static const std::vector<NestField> all = make_fields();
  return all;
}

void set_field(NestConfig& config, std::string_view name, std::string_view value) {
  const auto field = std::ranges::find(nest_fields(), name, &NestField::name);
  if (field == nest_fields().end()) throw unknown_name("field", name, names_of(nest_fields()));
  field->set(config, name, value);
}

void require_valid(const NestConfig& config) {
  if (config.outer.empty())
    throw InputError("no outer shape; expected a name of `bench list` or a mesh file");
  if (config.accuracy > 0 && (!config.free.empty() || config.scale))
    throw InputError("accuracy with free or scale; expected one of them");
  if ((config.layers > 0) + (config.accuracy > 0) + (config.landscape > 0) > 1)
    throw InputError("layers, accuracy and landscape together; expected one of them");
  if (config.layers > 0 && config.free.empty())
    throw InputError("layers without free; expected what the search for each may change, such as all");
  if (config.layers == 0 && (config.tolerances.inset() > 0 || !config.within.empty()))
    throw InputError(
        "printer-accuracy, wall or within without layers; expected layers, 1 for a single nesting");
  if (config.landscape > 0 && (!config.free.empty() || config.scale))
    throw InputError("landscape with free or scale; expected one of them");
  if (!config.free.empty() && config.scale)
    throw InputError("free with scale; expected one of them: a search finds the scale");
  if (config.free.empty()) return;
  if (const auto what = config.search.swarm.invalid()) throw InputError("swarm: " + *what);
  if (const auto what = config.search.climb.invalid()) throw InputError("climb: " + *what);
  if (nest::is_baseline(config.swarm) &&
      config.search.swarm.particles < nest::find_baseline(config.swarm).least_particles)
    throw InputError(fmt::format("{} with {} particles; expected at least {}", config.swarm,
                                 config.search.swarm.particles,
                                 nest::find_baseline(config.swarm).least_particles));
}

std::map<std::string, std::string> describe(const NestConfig& config) {
  static const NestConfig defaults;
  std::map<std::string, std::string> fields;
  for (const NestField& field : nest_fields())
    if (std::string text = field.text(config); field.name != "device" && text != field.text(defaults))
      fields.emplace(field.name, std::move(text));
  return fields;
}

std::string_view kind_of(const NestConfig& config) {
  if (config.layers > 0) return "layers";
  if (config.landscape > 0) return "landscape";
  return config.accuracy > 0 ? "accuracy" : !config.free.empty() ? "swarm" : config.scale ? "test" : "scale";
}

std::string shapes_text(const NestConfig& config) {
  std::string text;
  for (auto shape = config.within.rbegin(); shape != config.within.rend(); ++shape)
    text += stem(*shape) + " in ";
  return text + fmt::format("{} in {}", stem(config.inner.empty() ? config.outer : config.inner),
                            stem(config.outer));
}

std::string run_name(const NestConfig& config) {
  std::string shapes = shapes_text(config);
  std::ranges::replace(shapes, ' ', '-');
  return fmt::format("{}-{}-{:08x}", shapes, kind_of(config), hash(describe(config)));
}

}  // namespace kreisel::core
