// nest_run.hpp - one nesting run, from configuration to certified result.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "control.hpp"
#include "nest/decide/accuracy.hpp"
#include "nest/decide/certify.hpp"
#include "nest/plane/landscape.hpp"
#include "nest/search/layers.hpp"
#include "nest/search/optimise.hpp"
#include "run/nest_config.hpp"
#include "session/provenance.hpp"

namespace kreisel::core {

/// A search on its way, with what it was asked; one that goes on from here ends as if it had never stopped.
struct NestCheckpoint {
  NestConfig config;
  nest::SearchState state;
  std::vector<double> seconds;  ///< of the search, at the end of each iteration of state.trace
};

/// A variant at one placement: medians of wall time.
struct NestTiming {
  std::string variant;
  double test_ms = 0;    ///< of a test at 0.98 of the scale
  double search_ms = 0;  ///< of a search for the largest scale
  double scale = 0;      ///< that it found; 0: none
};

/// How large the shapes' outlines nest, wherever they are put.
struct NestLandscape {
  nest::PlaneShapes outlines;
  nest::Landscape map;
  double degrees = 0;  ///< of the best, counter-clockwise
};

struct NestResult {
  NestConfig config;
  Provenance provenance;
  std::size_t outer_triangles = 0, inner_triangles = 0;
  bool placed = false;  ///< there is a placement to speak of: that which was tested, or what was found
  bool valid = false;
  std::string text;  ///< the answer in words, with the first fault
  double scale = 0;
  /// In the outer shape's coordinates; the transform maps the inner's into them.
  Eigen::Matrix<double, 3, 4> transform = Eigen::Matrix<double, 3, 4>::Zero();
  Vec3 plane_point = Vec3::Zero(), plane_normal = Vec3::UnitZ(), plus = Vec3::UnitZ(), minus = -Vec3::UnitZ();
  std::uint64_t evaluations = 1;                  ///< tests of a bisection, rounds, or placements of a swarm
  std::optional<nest::CertifiedScale> certified;  ///< of what is valid, by the exact test
  std::optional<double>
      sampled_scale;  ///< of a swarm's best: the largest by views of `resolution`, the paper's yardstick
  std::vector<nest::SwarmStep> trace;  ///< of a swarm, an iteration each
  std::vector<double> trace_seconds;
  enum class Ending { whole, interrupted, out_of_time } ending = Ending::whole;
  double setup_seconds = 0, search_seconds = 0, certify_seconds = 0;
  std::vector<NestTiming> timings;
  std::optional<nest::Accuracy> accuracy;
  std::optional<nest::Layers> layers;  ///< what is above is then said of the first; times are those of all
  std::optional<NestLandscape> landscape;
  std::vector<TriangleMesh> shapes;  ///< the outermost first, a shape in itself once; where they are kept
};

/// "valid", "infeasible", "interrupted", "out of time"; of a comparison or a landscape "complete".
[[nodiscard]] std::string_view termination_of(const NestResult& result);

/// What a run tells and asks on its way.
struct NestHooks {
  Control control = {};
  /// Every half a minute, and at the end of a search over placements; like `resume` of that kind alone.
  std::function<void(const NestCheckpoint&)> keep = {};
  /// In place of the shapes that the configuration names: outer, inner and what is within, or one in itself.
  std::vector<TriangleMesh> shapes = {};
  /// Told of each iteration of a search, a layer's too; false ends it, and what was found is kept.
  std::function<bool(const nest::SearchState&)> on_iteration = {};
  const NestCheckpoint* resume = nullptr;
  /// Told of the search every NestSwarm::exchange iterations: a position that another one found, or nothing.
  std::function<std::vector<double>(const NestCheckpoint&)> exchange = {};
  nest::Optimiser optimise = nest::optimise;
};

/// @throws InputError  shapes, options or a checkpoint that do not fit; a checkpoint of another kind than a
///                     search over placements; a swarm that is a baseline's, unless
///                     hooks.optimise knows it
[[nodiscard]] NestResult run_nest(const NestConfig& config, const NestHooks& hooks = {});

}  // namespace kreisel::core
