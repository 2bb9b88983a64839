// config.hpp - a question about one body, and the solve that answers it; what `bench` parses and records
// store.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "body/body.hpp"
#include "domain/columns.hpp"
#include "settings/field.hpp"
#include "settings/settings.hpp"

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
inline const std::vector<std::string_view> ways_through = {"lowest", "centre"};  ///< by their numbers

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

/// Whether the shape may change where no interior will do. [docs/deformation.md]
struct DeformSpec {
  bool wanted = false;
  /// Largest displacement, percent of the longest side: the best objective within it. Nothing: as little as
  /// does.
  std::optional<double> within;
  std::vector<std::string> keep;  ///< what stays as it is: balls "x,y,z,r", mm, and meshes

  bool operator==(const DeformSpec&) const = default;
};

/// What solves, maps and simulations have in common: what is asked of which body, over which domain, where.
struct Asked {
  BodySpec body;
  std::optional<FreePose> free;  ///< in place of the body's axis, up and contact
  bool flatten = false;          ///< by as little as makes a base
  std::string problem = "spin", formulation = "rayrep";
  std::string solver;  ///< empty: the first that works with the formulation, see solver_of()
  std::string domain;  ///< columns or exact; empty: the formulation's own, see domain_of()
  GridSpec grid;
  Wall wall;
  std::string device;             ///< selector, see device.hpp
  bool single_precision = false;  ///< forces the kernels to compensated single precision
  /// `--set GROUP.NAME=VALUE`, checked by whom they are for; groups: setting_groups()
  SettingTexts settings;
};

/// A solve, and the part made of it. Defaults are those of `bench --formulation rayrep`.
struct RunConfig : Asked {
  DeformSpec deform;
  Rounding rounding = Rounding::fitted;
  Part part = Part::written;
  int repeat = 1;              ///< timed solves at most, >= 1
  double budget_seconds = 20;  ///< no further repetition starts once this is spent
  double certify = 0;          ///< relative gap to prove between result and bound; 0: no certificate
  Limits limits;               ///< of a run of an experiment
};

/// The fields of a solve, and those that other kinds of run have, too: model, problem, formulation, solver,
/// domain, resolution (N or NXxNYxNZ), level (of an octree: 2^level cells), wall, ... Settings of the groups
/// beside them are no fields (set_setting()), but for problems' that have an option of their own.
[[nodiscard]] const Fields<Asked>& asked_fields();
[[nodiscard]] const Fields<RunConfig>& solve_fields();
/// What becomes of the optimum: rounding.
[[nodiscard]] const Fields<RunConfig>& rounding_fields();

/// problem, formulation, solver, and the solvers that have settings of their own.
[[nodiscard]] const std::vector<std::string_view>& setting_groups();
/// Whether it is GROUP.NAME with one of these groups.
[[nodiscard]] bool is_setting(std::string_view key);
/// @throws InputError  a group that is none of these
void set_setting(Asked& asked, std::string_view key, std::string_view value);

/// Sets one field from text, or a setting GROUP.NAME.
///
/// @throws InputError  unknown key or unfit value; names both and what was expected
void set_field(RunConfig& config, std::string_view key, std::string_view value);

/// The solver that is asked for, or else the first that works with the formulation.
[[nodiscard]] std::string solver_of(const Asked& asked);

/// The domain that is asked for, or else the formulation's own.
///
/// @throws InputError  one that the formulation does not work on
[[nodiscard]] std::string domain_of(const Asked& asked);

/// The settings of one group, without its prefix.
[[nodiscard]] SettingTexts settings_of(const Asked& asked, std::string_view group);
/// Those of the problem, as it reads them. @throws InputError  an unknown setting, or a value that does not
/// fit
[[nodiscard]] Settings problem_settings(const Asked& asked);

/// Every setting GROUP.NAME of these groups, of whichever problem, formulation or solver.
[[nodiscard]] std::vector<std::string> setting_names(const std::vector<std::string_view>& groups);

/// Looks at a setting GROUP.NAME of whom it is for, or at all that are there, ahead of any work.
/// @throws InputError  an unknown setting, or a value that does not fit
void require_setting(const Asked& asked, std::string_view key, const std::string& value);
void require_settings(const Asked& asked);

/// Every field that defines the result (not repeat, budget and limits) as sorted key -> text; the identity of
/// a run.
[[nodiscard]] std::map<std::string, std::string> describe(const RunConfig& config);

/// Stable file stem of a run: readable parts and a hash of describe(), e.g.
/// "ellipsoid-80x52x51-spin-rayrep-ipopt-1a2b3c4d".
[[nodiscard]] std::string run_name(const RunConfig& config);

/// The same for any kind that asks of a body. @param fields  as describe() gives them  @param way  how it is
/// answered: "rayrep-ipopt", "map"
[[nodiscard]] std::string run_name(const Asked& asked, const std::map<std::string, std::string>& fields,
                                   std::string_view way);

/// "ellipsoid", of a mesh file its stem.
[[nodiscard]] std::string model_text(const Asked& asked);
/// "80x52x51", or "64" when only the longest side is given.
[[nodiscard]] std::string grid_text(const GridSpec& grid);

}  // namespace kreisel::core
