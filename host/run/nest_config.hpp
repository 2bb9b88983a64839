// nest_config.hpp - everything that defines one nesting run; what `bench nest` parses and its record stores.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "nest/search/layers.hpp"
#include "nest/search/optimise.hpp"
#include "settings/field.hpp"

namespace kreisel::core {

// What kinds of nestings share. Points and lengths are in the outer shape's coordinates, after it was scaled
// to `outer_size`.

/// Which shapes, and where they are computed.
struct NestShapes {
  std::string outer, inner;  ///< names of `bench list`, or files; inner empty: the outer shape in itself
  std::optional<double> outer_size, inner_size;  ///< longest sides; none: as the files are
  int fineness = 0;                              ///< of parametric models; 0: their own
  bool keep_shapes = false;                      ///< the record holds the meshes, for pictures
  std::string device;
};

/// How the inner shape is turned, and the cut.
struct NestTurn {
  Vec3 rotation = Vec3::Zero();                  ///< axis times degrees
  Vec3 plane = Vec3::UnitZ();                    ///< normal of the cut
  std::optional<std::pair<Vec3, Vec3>> removal;  ///< of the halves above and below; none: along the normal
};

/// Where they are.
struct NestPlace {
  std::optional<Vec3> centroid;  ///< where the inner shape's goes; none: where the outer's is
  std::optional<Vec3> through;   ///< a point of the cut; none: the inner's centroid
};

/// What decides whether they nest, and how large.
struct NestDecision {
  std::string variant = "hybrid";  ///< a name of nest::make_search()
  int resolution = 512;            ///< of its views, where it has any
  std::optional<double> upper;     ///< bound of scales; none: what can fit
  double tolerance = 1e-4;         ///< of a scale that is searched
};

/// How the largest nesting is searched for.
struct NestSearch {
  NestSearch();

  std::string free;                    ///< what may change, as Freedom::set_free() takes it
  std::string swarm = "hybrid+abort";  ///< a name of nest::variants() or of nest::baselines
  Vec3 up = Vec3::UnitZ();             ///< what an upright inner shape turns about
  std::vector<nest::KeepOut> keep_outs;
  nest::PlacementSearchOptions search;  ///< not by the paper's defaults but by what pso_variants recommends
  double seconds = std::numeric_limits<double>::infinity();  ///< after which the search ends
};

// The kinds.

/// Does it nest at this scale?
struct NestTest : NestTurn, NestPlace, NestDecision {
  std::optional<double> scale;
  int timings = 0;  ///< repetitions by which every variant is timed at the placement; 0: none
};

/// Up to which scale does it nest there?
struct NestScale : NestTurn, NestPlace, NestDecision {
  int timings = 0;
};

/// Where does it nest largest? What is not free is as given.
struct NestSwarm : NestTurn, NestPlace, NestDecision, NestSearch {
  int timings = 0;
  int exchange =
      0;  ///< iterations after which islands, swarms of other seeds, hear of each other's best; 0: never
};

/// The same for each of several layers; what is not free lies about the centroid of the space inside.
struct NestLayers : NestTurn, NestDecision, NestSearch {
  int layers = 0;                   ///< times that a shape is put into another
  std::vector<std::string> within;  ///< shapes inside the inner one, the outermost first
  nest::Tolerances tolerances;
  int cells = nest::LayersSpec().cells;  ///< of their offsets
};

/// How far do sampled scales lie from exact ones, over random placements?
struct NestAccuracy {
  int accuracy = 0;  ///< placements
  std::uint64_t seed = 1;
};

/// Where do the shapes' outlines nest how large?
struct NestOutlines {
  int landscape = 0;           ///< centroids along the longer side of the outline
  int rotations = 4096;        ///< of each
  Vec3 view = -Vec3::UnitY();  ///< from the shapes to the eye that sees their outlines, `up` upwards
  Vec3 up = Vec3::UnitZ();
  double tolerance = 1e-4;  ///< of the scale that is certified
};

using NestKind = std::variant<NestScale, NestTest, NestSwarm, NestLayers, NestAccuracy, NestOutlines>;

/// One run.
struct NestConfig : NestShapes {
  NestKind kind;
};

/// A kind by name, and the fields of a nesting of it. Those of the alternatives of NestKind, in their order.
struct NestKindEntry {
  std::string_view name, what, help;
  std::string_view by;  ///< the field that makes a nesting one of this kind; empty: it has none of those
  NestKind empty;
  Fields<NestConfig> fields;
};

[[nodiscard]] const std::vector<NestKindEntry>& nest_kinds();
[[nodiscard]] const NestKindEntry& entry_of(const NestConfig& config);

/// Field and text, as they are given.
using GivenFields = std::vector<std::pair<std::string, std::string>>;

/// The kind that these fields make a nesting: the first whose own field is among them; else a search of the
/// scale.
[[nodiscard]] const NestKindEntry& nest_kind_of(const std::vector<std::string_view>& names);

/// @throws InputError  as set_field()
[[nodiscard]] NestConfig make_nest(const GivenFields& given);

/// @throws InputError  unknown name, says the nearest; a field of other kinds, says which; a value that does
///                     not fit, with what was expected
void set_field(NestConfig& config, std::string_view name, std::string_view value);

/// What set_field() cannot see in one field: options of the search that do not fit, a direction that is zero.
/// @throws InputError
void require_valid(const NestConfig& config);

/// Every field that is not at its default, but the device; the identity of a run.
[[nodiscard]] std::map<std::string, std::string> describe(const NestConfig& config);

/// "test", "scale", "swarm", "layers", "accuracy" or "landscape".
[[nodiscard]] std::string_view kind_of(const NestConfig& config);

/// The part of a nesting's kind that it shares with others; nullptr: its kind has none of it.
template <class Part>
[[nodiscard]] const Part* part_of(const NestConfig& config) {
  return std::visit(
      [](const auto& kind) -> const Part* {
        if constexpr (std::is_base_of_v<Part, std::decay_t<decltype(kind)>>) return &kind;
        return nullptr;
      },
      config.kind);
}
template <class Part>
[[nodiscard]] Part* part_of(NestConfig& config) {
  return const_cast<Part*>(part_of<Part>(std::as_const(config)));
}

/// Of random placements, and of swarms; 1 of what has neither.
[[nodiscard]] std::uint64_t seed_of(const NestConfig& config);

/// "bunny in bunny"; files by their stem.
[[nodiscard]] std::string shapes_text(const NestConfig& config);

/// Stable file stem: shapes, kind and a hash of describe(), as "bunny-in-bunny-swarm-1a2b3c4d".
[[nodiscard]] std::string run_name(const NestConfig& config);

}  // namespace kreisel::core
