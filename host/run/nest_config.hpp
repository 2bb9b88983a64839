// nest_config.hpp - everything that defines one nesting run; what `bench nest` parses and its record stores.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nest/search/layers.hpp"
#include "nest/search/optimise.hpp"

namespace kreisel::core {

/// One run: a feasibility test (`scale` is given), a scale search (it isn't), a search over placements
/// (`free` names something), one for each of several layers (`layers`), a comparison of variants over random
/// placements (`accuracy`), or a map of where the shapes' outlines nest how large (`landscape`). Points and
/// lengths are in the outer shape's coordinates, after it was scaled to `outer_size`.
struct NestConfig {
  std::string outer, inner;  ///< names of `bench list`, or files; inner empty: the outer shape in itself
  std::optional<double> outer_size, inner_size;  ///< longest sides; none: as the files are
  int fineness = 0;                              ///< of parametric models; 0: their own

  Vec3 rotation = Vec3::Zero();                  ///< of the inner shape: axis times degrees
  std::optional<Vec3> centroid;                  ///< where its centroid goes; none: where the outer's is
  Vec3 plane = Vec3::UnitZ();                    ///< normal of the cut
  std::optional<Vec3> through;                   ///< a point of the cut; none: the inner's centroid
  std::optional<std::pair<Vec3, Vec3>> removal;  ///< of the halves above and below; none: along the normal

  std::string variant = "hybrid";      ///< what decides: a name of nest::make_search()
  int resolution = 512;                ///< of its views, where it has any
  std::optional<double> scale, upper;  ///< to test; bound of a search
  double tolerance = 1e-4;             ///< of a scale that is searched

  std::string free;                    ///< what may change, as Freedom::set_free() takes it; empty: nothing
  std::string swarm = "hybrid+abort";  ///< a name of nest::variants() or of nest::baselines
  Vec3 up = Vec3::UnitZ();             ///< what an upright inner shape turns about
  std::vector<nest::KeepOut> keep_outs;
  nest::PlacementSearchOptions search;  ///< not by the paper's defaults but by what pso_variants recommends
  double seconds = std::numeric_limits<double>::infinity();  ///< after which the search ends

  int layers = 0;                        ///< times that a shape is put into another; 0: no layers
  std::vector<std::string> within;       ///< of layers: shapes inside the inner one, the outermost first
  nest::Tolerances tolerances;           ///< of layers
  int cells = nest::LayersSpec().cells;  ///< of their offsets

  int landscape = 0;           ///< centroids along the longer side of the outline; 0: no landscape
  int rotations = 4096;        ///< of each
  Vec3 view = -Vec3::UnitY();  ///< from the shapes to the eye that sees their outlines, `up` upwards
  bool keep_shapes = false;    ///< the record holds the meshes, for pictures

  int accuracy = 0;  ///< random placements over which variants are compared; 0: no comparison
  int timings = 0;   ///< repetitions by which every variant is timed at the placement found; 0: none
  std::string device;

  NestConfig();
};

/// A field as the command line, TOML files and records name it.
struct NestField {
  std::string_view name, help;
  int words = 1;  ///< that its value consists of, with spaces between; 0: any number of them
  void (*set)(NestConfig& config, std::string_view name, std::string_view value);
  std::string (*text)(const NestConfig& config);
};

/// All of them, in the order in which help lists them.
[[nodiscard]] const std::vector<NestField>& nest_fields();

/// @throws InputError  unknown name, says the nearest; or a value that does not fit, with what was expected
void set_field(NestConfig& config, std::string_view name, std::string_view value);

/// What set_field() cannot see in one field: options of the search that do not fit, a direction that is zero.
/// @throws InputError
void require_valid(const NestConfig& config);

/// Every field that is not at its default, but the device; the identity of a run.
[[nodiscard]] std::map<std::string, std::string> describe(const NestConfig& config);

/// "test", "scale", "swarm", "layers", "accuracy" or "landscape".
[[nodiscard]] std::string_view kind_of(const NestConfig& config);

/// "bunny in bunny"; files by their stem.
[[nodiscard]] std::string shapes_text(const NestConfig& config);

/// Stable file stem: shapes, kind and a hash of describe(), as "bunny-in-bunny-swarm-1a2b3c4d".
[[nodiscard]] std::string run_name(const NestConfig& config);

}  // namespace kreisel::core
