#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>

#include "body/source.hpp"
#include "error.hpp"
#include "formulation/formulation.hpp"
#include "parse.hpp"
#include "problem/problem.hpp"
#include "session/config.hpp"
#include "session/mending_fields.hpp"
#include "settings/field_text.hpp"
#include "solve/solver.hpp"

namespace kreisel::core {
using namespace field_text;
namespace {

using A = Asked&;
using ConstA = const Asked&;
using C = RunConfig&;
using ConstC = const RunConfig&;
using S = std::string_view;

const std::vector<S> domains = {"columns", "exact"};

GridSpec grid(S key, S value) {
  GridSpec spec;
  std::vector<int> cells;
  for (const S part : split(value, 'x')) cells.push_back(parse<int>(part).value_or(-1));
  if (cells.size() == 1 && cells[0] >= 2)
    spec.resolution = cells[0];
  else if (cells.size() == 3 && std::ranges::min(cells) >= 2)
    spec.cells = {cells[0], cells[1], cells[2]};
  else
    refuse(key, value, "cells along the longest side (2 to 1024), or NXxNYxNZ");
  return spec;
}

/// Levels that are too many are refused by the grid, with the memory that they would need.
GridSpec grid_of_level(S key, S value) {
  constexpr int most = 20;
  const int level = parse<int>(value).value_or(-1);
  if (level < 1 || level > most) refuse(key, value, "1 to 10: 2^level cells along the longest side");
  GridSpec spec;
  spec.resolution = 1 << level;
  return spec;
}

std::string point_text(const std::optional<Vec3>& v) { return v ? text_of(*v) : ""; }

FreePose& free_pose_of(A asked) { return asked.free ? *asked.free : asked.free.emplace(); }

/// A direction, or how one is to be found. @param rests  by the number of a way of lying, too
void set_direction(A asked, std::optional<Vec3>& direction, S key, S value, bool rests) {
  constexpr S near = "near:", rest = "rest:";
  const auto begin = [&](std::optional<Vec3> to, std::optional<int> number) {
    direction.reset();
    FreePose& free = free_pose_of(asked);
    free.near = std::move(to);
    free.rest = number;
  };
  if (value == "auto") return begin({}, {});
  if (value.starts_with(near)) {
    const Vec3 to = vector(key, value.substr(near.size()));
    if (!to.allFinite() || to.norm() == 0) refuse(key, value, "near: and a direction other than zero");
    return begin(to, {});
  }
  if (rests && value.starts_with(rest)) return begin({}, whole(key, value.substr(rest.size()), 1));
  if (!parse_vector(value))
    refuse(key, value, rests ? "x,y,z, auto, near:x,y,z or rest:N" : "x,y,z, auto or near:x,y,z");
  direction = vector(key, value);
  if (!asked.free) return;
  if (asked.free->through)  // of an axis that is given
    asked.free->near = {}, asked.free->rest = {};
  else
    asked.free.reset();
}

/// What set_direction() takes. @param upright  it is the direction that its problem goes by
std::string direction_text(ConstA asked, const std::optional<Vec3>& direction, bool upright) {
  if (direction || !asked.free || find_problem(asked.problem).upright != upright)
    return point_text(direction);
  const FreePose& free = *asked.free;
  return free.rest   ? fmt::format("rest:{}", *free.rest)
         : free.near ? "near:" + text_of(*free.near)
                     : std::string("auto");
}

/// Shapes that are made along the axis: what is joined, what is cut off; and where an axis runs that is
/// found.
Fields<Asked> shape_fields() {
  return grouped<Asked>(
      "pose and material",
      {chosen_from<Asked>(
           words_of(ways_through),
           {"axis-through", "",
            "where an axis that is to be found runs: lowest (through the lowest point along it) or centre "
            "(through the centre of mass, on a stem); default: lowest, else centre",
            [](A a, S k, S v) {
              free_pose_of(a).through = static_cast<Through>(word_of(k, v, ways_through));
            },
            [](ConstA a) {
              if (!a.free || !a.free->through) return std::string();
              return std::string(ways_through[static_cast<std::size_t>(*a.free->through)]);
            }}),
       {"stem", "mm",
        "radius of a peg to spin on; it runs along the axis, down to the height of the lowest point",
        [](A a, S k, S v) { a.body.stem.radius = number(k, v); },
        [](ConstA a) { return number_text(a.body.stem.radius); }},
       {"tip", "R[,H]",
        "radius and height of the cone at the end of the stem, mm; default: the stem's radius",
        [](A a, S k, S v) {
          const auto parts = split(v, ',');
          if (parts.size() > 2) refuse(k, v, "a radius, or a radius and a height R,H in mm");
          a.body.stem.tip_radius = number(k, parts[0]);
          a.body.stem.tip_height.reset();
          if (parts.size() == 2) a.body.stem.tip_height = number(k, parts[1]);
        },
        [](ConstA a) {
          const StemSpec& stem = a.body.stem;
          return number_text(stem.tip_radius) + (stem.tip_height ? "," + number_text(stem.tip_height) : "");
        }},
       {"flatten", "mm", "cut so much off the bottom; auto: the least that makes a base to stand on",
        [](A a, S k, S v) {
          a.flatten = v == "auto";
          a.body.flatten.reset();
          if (!a.flatten && !parse<double>(v)) refuse(k, v, "mm, or auto");
          if (!a.flatten) a.body.flatten = number(k, v);
        },
        [](ConstA a) { return a.flatten ? std::string("auto") : number_text(a.body.flatten); }}});
}

/// Which body, and how large.
Fields<Asked> body_fields() {
  return grouped<Asked>(
      "body",
      {chosen_from<Asked>(
           shape_names,
           {"model", "",
            "the body: a name of `bench list`, or a mesh file (STL, 3MF, OBJ, PLY, OFF); default ellipsoid",
            [](A a, S, S v) { a.body.model = v; }, [](ConstA a) { return a.body.model; }, Identity::always, 1,
            true}),
       chosen_from<Asked>(
           names_in(length_units),
           {"unit", "",
            "unit of an STL, OBJ, PLY or OFF file, which does not say it: mm, cm, m or in; default mm",
            [](A a, S, S v) { a.body.unit = find_length_unit(v); },
            [](ConstA a) { return a.body.unit ? std::string(a.body.unit->name) : ""; }}),
       {"size", "mm", "scale the body to this longest side; default: as the model is",
        [](A a, S k, S v) { a.body.size = number(k, v); }, [](ConstA a) { return number_text(a.body.size); }},
       {"fineness", "", "n: a model of our own gets about 20 n^2 triangles",
        [](A a, S k, S v) { a.body.fineness = whole(k, v, 1); },
        [](ConstA a) { return std::to_string(a.body.fineness); }}});
}

Fields<Asked> mending_of_body() {
  return fields_of_part<Asked>(
      mending_fields(), [](auto& asked) -> auto& { return asked.body.mending; });
}

/// How it lies, and what it is of.
Fields<Asked> pose_fields() {
  return grouped<Asked>(
      "pose and material",
      {{"axis", "x,y,z",
        "spin axis in model coordinates; auto finds the best, near:x,y,z the best within 30 degrees; "
        "default: up",
        [](A a, S k, S v) { set_direction(a, a.body.axis, k, v, false); },
        [](ConstA a) { return direction_text(a, a.body.axis, false); }},
       {"contact", "x,y,z",
        "a point of the axis, mm; default: the lowest point along it, for yoyo the centre of mass",
        [](A a, S k, S v) { a.body.contact = vector(k, v); },
        [](ConstA a) { return point_text(a.body.contact); }},
       {"up", "x,y,z",
        "which way is up; auto finds the best pose, near:x,y,z the best near that, rest:N the N-th most "
        "probable way of lying; default: the model's, else 0,0,1",
        [](A a, S k, S v) { set_direction(a, a.body.up, k, v, true); },
        [](ConstA a) { return direction_text(a, a.body.up, true); }},
       {"density", "g/cm^3", "density of the shell; default 1",
        [](A a, S k, S v) { a.body.density = number(k, v); },
        [](ConstA a) { return number_text(a.body.density); }, Identity::always},
       {"interior-density", "g/cm^3", "density of what is left of the interior; default: the shell's",
        [](A a, S k, S v) { a.body.interior_density = number(k, v); },
        [](ConstA a) { return number_text(a.body.interior_density); }},
       {"void-density", "g/cm^3", "density of what fills the voids; default 0",
        [](A a, S k, S v) { a.body.void_density = number(k, v); },
        [](ConstA a) { return number_text(a.body.void_density); }},
       {"axle", "mm", "yoyo: radius of an axle between two halves; default: none, the body stays whole",
        [](A a, S k, S v) { a.body.axle.radius = number(k, v); },
        [](ConstA a) { return number_text(a.body.axle.radius); }},
       {"slot", "mm", "yoyo: gap between the halves; default: the axle's radius",
        [](A a, S k, S v) { a.body.axle.slot = number(k, v); },
        [](ConstA a) { return number_text(a.body.axle.slot); }},
       {"axle-depth", "mm", "yoyo: depth of the hole for the axle in each half; default: twice its radius",
        [](A a, S k, S v) { a.body.axle.depth = number(k, v); },
        [](ConstA a) { return number_text(a.body.axle.depth); }}});
}

/// What is asked, and how it is answered. A name that nobody knows is told where it is written, not when its
/// turn comes.
Fields<Asked> question_fields() {
  return grouped<Asked>("question", {{"problem", "", "what the body is to do; default spin",
                                      [](A a, S, S v) { a.problem = find_problem(v).name; },
                                      [](ConstA a) { return a.problem; }, Identity::always},
                                     {"formulation", "", "how the interior is described; default rayrep",
                                      [](A a, S, S v) { a.formulation = find_formulation(v).name; },
                                      [](ConstA a) { return a.formulation; }, Identity::always},
                                     {"solver", "",
                                      "what solves the problem; default: the first that works with the "
                                      "formulation (ipopt, for quadric moment)",
                                      [](A a, S, S v) {
                                        (void)solvers().find(v);
                                        a.solver = v;
                                      },
                                      [](ConstA a) { return solver_of(a); }, Identity::always}});
}

/// Over which domain.
Fields<Asked> domain_fields() {
  return grouped<Asked>(
      "domain", {chosen_from<Asked>(words_of(domains),
                                    {"domain", "",
                                     "what can be hollowed, as columns (whole cells) or exact (rays cut at "
                                     "the wall); default columns, for quadric exact",
                                     [](A a, S k, S v) { a.domain = domains[word_of(k, v, domains)]; },
                                     [](ConstA a) { return domain_of(a); }}),
                 {"resolution", "", "cells along the longest side, or NXxNYxNZ; default 64",
                  [](A a, S k, S v) { a.grid = grid(k, v); }, [](ConstA a) { return grid_text(a.grid); },
                  Identity::always},
                 {"level", "", "octree: 2^level cells along the longest side",
                  [](A a, S k, S v) { a.grid = grid_of_level(k, v); }, [](ConstA) { return std::string(); },
                  Identity::none},
                 {"wall", "",
                  "least thickness of the wall: in cells (1.5h), in per cent of the longest side (2%), or in "
                  "mm; default 1.5h",
                  [](A a, S, S v) {
                    const bool to_corners = a.wall.to_corners;
                    a.wall = parse_wall(std::string(v));
                    a.wall.to_corners = to_corners;
                  },
                  [](ConstA a) { return to_string(a.wall); }, Identity::always},
                 one_of<Asked>(
                     "wall-to",
                     "what of a voxel keeps the wall's distance from the surface: its centre (centres, "
                     "default) or all of it (corners)",
                     {"centres", "corners"}, [](auto& a) -> auto& { return a.wall.to_corners; })});
}

Fields<Asked> device_fields() {
  return grouped<Asked>("device",
                        {{"device", "",
                          "OpenCL device: its index, or part of its name; default: KREISEL_DEVICE, else a "
                          "GPU, else PoCL on the processor",
                          [](A a, S, S v) { a.device = v; }, [](ConstA a) { return a.device; }},
                         one_of<Asked>(
                             "precision", "arithmetic of the kernels: automatic, or single (compensated)",
                             {"automatic", "single"}, [](auto& a) -> auto& { return a.single_precision; })});
}

/// Each setting of a problem has an option of its own. Its text is said among the settings.
Fields<Asked> setting_fields() {
  struct Words {
    std::string name, unit, help;
    std::string of, last;  ///< the problems that say the last of it alike, and what that is
    Choices choices;
  };
  static std::deque<Words> kept;  // fields only look at them
  for (const ProblemEntry& problem : problems())
    for (const Field<Settings>& setting : problem.settings.fields()) {
      const std::string name = fmt::format("problem.{}", setting.name);
      auto words = std::ranges::find(kept, name, &Words::name);
      if (words == kept.end())
        words = kept.insert(kept.end(), {name, std::string(setting.unit), "", "", "", setting.choices});
      if (words->last == setting.help) {
        words->of += ", " + problem.name;
      } else {
        words->help += words->of.empty() ? "" : fmt::format("{}: {}; ", words->of, words->last);
        words->of = problem.name, words->last = setting.help;
      }
    }
  for (Words& words : kept) words.help += fmt::format("{}: {}", words.of, words.last);
  Fields<Asked> fields;
  for (const Words& words : kept) {
    Field<Asked> field{words.name, words.unit, words.help,
                       [](A a, S k, S v) { a.settings[std::string(k)] = v; },
                       [name = words.name](ConstA a) {
                         const auto found = a.settings.find(name);
                         return found == a.settings.end() ? "" : found->second;
                       }};
    field.choices = words.choices;
    fields.push_back(std::move(field));
  }
  return grouped("the problem's settings", fields);
}

/// Whether the shape may change, and what of it not.
Fields<RunConfig> deform_fields() {
  return grouped<RunConfig>(
      "deformation",
      {chosen_from<RunConfig>(words_of({"least"}),
                              {"deform", "",
                               "let the shape change: least (as little as does), or at most N% of the "
                               "longest side (the best within it); default: it stays",
                               [](C c, S k, S v) {
                                 c.deform.wanted = true;
                                 c.deform.within.reset();
                                 if (v == "least") return;
                                 const double percent = parse_with_unit(v, "%").value_or(-1);
                                 if (!(percent > 0 && percent <= 50))
                                   refuse(k, v, "least, or a share above 0 and up to 50% such as 5%");
                                 c.deform.within = percent;
                               },
                               [](ConstC c) {
                                 if (!c.deform.wanted) return std::string();
                                 return c.deform.within ? fmt::format("{}%", *c.deform.within)
                                                        : std::string("least");
                               }}),
       {"keep", "",
        "what of the shape stays as it is: a ball x,y,z,r in mm, or the inside of a mesh file; several with "
        "; between",
        [](C c, S k, S v) {
          c.deform.keep.clear();
          for (const S one : split(v, ';')) {
            if (one.empty()) refuse(k, v, "x,y,z,r in mm, or a mesh file; several apart by ';'");
            c.deform.keep.emplace_back(one);
          }
        },
        [](ConstC c) { return fmt::format("{}", fmt::join(c.deform.keep, ";")); }}});
}

/// How often, how long, how near, and whether a part is made.
Fields<RunConfig> effort_fields() {
  return grouped<RunConfig>(
      "effort",
      {one_of<RunConfig>(
           "part", "whether a part is made: written (default), or none: the run ends with the solve",
           {"none", "written"}, [](auto& c) -> auto& { return c.part; }),
       {"repeat", "", "time at most so many solves; default 1",
        [](C c, S k, S v) { c.repeat = whole(k, v, 1); }, [](ConstC c) { return std::to_string(c.repeat); },
        Identity::none},
       {"budget", "s", "start no further repetition after this time; default 20",
        [](C c, S k, S v) {
          c.budget_seconds = number(k, v);
          if (c.budget_seconds < 0) refuse(k, v, "seconds >= 0");
        },
        [](ConstC c) { return number_text(c.budget_seconds); }, Identity::none},
       {"certify",
        "",
        "prove that the result is no further from the best than this relative gap; without a value 1e-3",
        [](C c, S k, S v) {
          c.certify = number(k, v);
          if (!(c.certify > 0 && c.certify < 1)) refuse(k, v, "a gap between 0 and 1, such as 1e-3");
        },
        [](ConstC c) { return number_text(c.certify); },
        Identity::changed,
        1,
        false,
        "",
        {},
        "1e-3"},
       {"memory", "GB",
        "experiments: the most memory that the run may use, as a process of its own; default: what there is",
        [](C c, S k, S v) {
          c.limits.gigabytes = number(k, v);
          if (!(c.limits.gigabytes > 0)) refuse(k, v, "GB > 0");
        },
        [](ConstC c) { return number_text(c.limits.gigabytes); }, Identity::none},
       {"seconds", "s",
        "experiments: the longest that the run may take, as a process of its own; default: for ever",
        [](C c, S k, S v) {
          c.limits.seconds = number(k, v);
          if (!(c.limits.seconds > 0)) refuse(k, v, "seconds > 0");
        },
        [](ConstC c) { return number_text(c.limits.seconds); }, Identity::none}});
}

}  // namespace

const Fields<Asked>& asked_fields() {
  static const Fields<Asked> all = [] {
    Fields<Asked> fields =
        joined<Asked>(body_fields(), mending_of_body(), pose_fields(), shape_fields(), question_fields(),
                      domain_fields(), device_fields(), setting_fields());
    const auto choose = [&](S name, Choices choices) {
      std::ranges::find(fields, name, &Field<Asked>::name)->choices = std::move(choices);
    };
    choose("axis", words_of({"auto", "near:"}));
    choose("up", words_of({"auto", "near:", "rest:"}));
    choose("flatten", words_of({"auto"}));
    choose("problem", names_in(problems));
    choose("formulation", names_in(formulations));
    choose("solver", names_in(solvers));
    return fields;
  }();
  return all;
}

const Fields<RunConfig>& rounding_fields() {
  static const Fields<RunConfig> all =
      grouped<RunConfig>("effort", {one_of<RunConfig>(
                                       "rounding",
                                       "how the written part is rounded to whole cells: nearest, or fitted "
                                       "so that the constraints hold (default)",
                                       {"nearest", "fitted"}, [](auto& c) -> auto& { return c.rounding; })});
  return all;
}

const Fields<RunConfig>& solve_fields() {
  static const Fields<RunConfig> all =
      joined<RunConfig>(asked_fields(), deform_fields(), rounding_fields(), effort_fields());
  return all;
}

}  // namespace kreisel::core
