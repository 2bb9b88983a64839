// config.hpp - everything that defines one run; what `bench` parses and every record stores.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "body/body.hpp"
#include "domain/columns.hpp"

namespace kreisel::core {

/// How the optimum becomes whole voxels: each end to its nearest face, as the papers do, or then moved voxel
/// by voxel until the constraints hold.
enum class Rounding { nearest, fitted };

/// Whether a run goes on to make the part, write it and judge the file, or ends with the solve: on fine grids
/// the part takes minutes, the solve milliseconds.
enum class Part { none, written };

/// Where an axis runs through the body: through its lowest point along the axis, on which it then spins; or
/// through the solid's centre of mass, on a peg as long as it takes to touch the ground at the lowest point's
/// height.
enum class Through { lowest, centre };

/// Every orientation instead of one. [docs/map.md]
struct MapConfig {
  int axes = 2000;  ///< directions of the sphere
  Through through = Through::lowest;
  std::vector<std::string> drafts;  ///< of `float`: a case each, as `problem.draft` takes them
};

/// A pose that is to be found: of the problem's own direction, axis or up. [docs/poses.md]
struct FreePose {
  std::optional<Vec3> near;        ///< the best within 30 degrees of it; nothing: of all
  std::optional<int> rest;         ///< the N-th most probable way of lying, from 1
  std::optional<Through> through;  ///< of an axis; nothing: lowest, and where none will do centre on a stem

  bool operator==(const FreePose&) const = default;
};

/// What a run may take, as a process of its own. 0: as much as there is.
struct Limits {
  double gigabytes = 0;  ///< 1e9 bytes of memory in use; what is asked for and never touched does not count
  double seconds = 0;    ///< from start to end, wall time

  [[nodiscard]] bool any() const { return gigabytes > 0 || seconds > 0; }
};

/// One run. Defaults are those of `bench --formulation rayrep`.
struct RunConfig {
  BodySpec body;
  std::optional<FreePose> free;  ///< in place of the body's axis, up and contact
  bool flatten = false;          ///< by as little as makes a base
  std::string problem = "spin", formulation = "rayrep";
  std::string solver;  ///< empty: the first that works with the formulation, see solver_of()
  std::string domain;  ///< columns or exact; empty: the formulation's own, see domain_of()
  GridSpec grid;
  Wall wall;
  Rounding rounding = Rounding::fitted;
  Part part = Part::written;
  std::string device;             ///< selector, see device.hpp
  bool single_precision = false;  ///< forces the kernels to compensated single precision
  std::map<std::string, std::string>
      settings;                ///< `--set GROUP.NAME=VALUE`; groups: ipopt moment problem formulation solver
  int repeat = 1;              ///< timed solves at most, >= 1
  double budget_seconds = 20;  ///< no further repetition starts once this is spent
  double certify = 0;          ///< relative gap to prove between result and bound; 0: no certificate
  Limits limits;               ///< of a run of an experiment
  std::optional<MapConfig> map;  ///< the run is a map of orientations, by quadric and moment, not a solve
};

/// Sets one field from text, as the command line and TOML files name them: model, problem, formulation,
/// solver, domain, resolution (N or NXxNYxNZ), level (of an octree: 2^level cells), wall, wall-to (centres or
/// corners of voxels), rounding, part,
/// axis, contact, up ("x,y,z"; axis and up also auto or near:x,y,z, up also rest:N), axis-through (lowest or
/// centre, of an axis that is to be found), stem, tip (mm; tip R,H), flatten (mm or auto), unit, size,
/// density, interior-density, void-density, axle, slot, axle-depth (mm), fineness, device, precision, repeat,
/// budget, memory (GB), seconds, certify, and GROUP.NAME for settings. Any of axes, through and drafts
/// ("20%,40%") makes the run a map.
///
/// @throws InputError  unknown key or unfit value; names both and what was expected
void set_field(RunConfig& config, std::string_view key, std::string_view value);

/// The solver that is asked for, or else the first that works with the formulation.
[[nodiscard]] std::string solver_of(const RunConfig& config);

/// The domain that is asked for, or else the formulation's own: exact for quadric, columns for those that
/// need voxels or whole cells.
///
/// @throws InputError  exact with a formulation that cannot work on it
[[nodiscard]] std::string domain_of(const RunConfig& config);

/// The settings of one group, without its prefix.
[[nodiscard]] std::map<std::string, std::string> settings_of(const RunConfig& config, std::string_view group);

/// Every field that defines the result (not repeat, budget and limits) as sorted key -> text; the identity of
/// a run.
[[nodiscard]] std::map<std::string, std::string> describe(const RunConfig& config);

/// Stable file stem of a run: readable parts and a hash of describe(), e.g.
/// "ellipsoid-80x52x51-spin-rayrep-ipopt-1a2b3c4d", or "bunny-100-spin-map-1a2b3c4d".
[[nodiscard]] std::string run_name(const RunConfig& config);

}  // namespace kreisel::core
