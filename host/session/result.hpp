// result.hpp - what one run gives, ready to be recorded.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "body/frame.hpp"
#include "domain/exact.hpp"
#include "fabricate/verify.hpp"
#include "fabricate/voids.hpp"
#include "session/config.hpp"
#include "session/deformation_report.hpp"
#include "session/provenance.hpp"
#include "solve/certificate.hpp"
#include "solve/solver.hpp"

namespace kreisel::core {

/// Seconds of one timed solve. `kernels` (device events) is part of `solve`; total = setup + solve.
struct Seconds {
  double setup = 0, kernels = 0, solve = 0, total = 0;
};

/// What rounding to whole voxels, or meshing a smooth cavity, gave, and what it cost. Body units.
struct RoundingCost {
  double objective = 0;               ///< after rounding
  double violation = 0;               ///< largest, after rounding
  Moments moments = Moments::Zero();  ///< totals
  std::size_t solid_voxels = 0, void_voxels = 0, mended_voxels = 0;
  std::size_t moved_voxels = 0;  ///< to meet the constraints
  int corrections = 0;           ///< of a smooth cavity's quadric, to meet them
};

/// The written part, judged from the file that was written.
struct Verified {
  Verdict verdict;
  std::string file;                   ///< empty: it was not written
  Moments moments = Moments::Zero();  ///< of that file, body frame and units
  double rounding_mismatch =
      0;  ///< largest |difference| to RoundingCost::moments: must be round-off of the file
  std::size_t triangles = 0, void_triangles = 0;  ///< of all files; of the voids' boundary
  std::vector<WrittenMaterial> materials;         ///< one or more; files empty when temporary
};

/// One finished run.
struct RunResult {
  RunConfig config;
  Provenance provenance;

  // The body and its domain, model units: mm and g.
  std::string body_name;
  std::vector<std::string> repairs;  ///< what was mended in the mesh file
  Frame frame;
  Vec3 axis = Vec3::UnitZ(), contact = Vec3::Zero();
  double density = 1, interior_density = 1, void_density = 0;
  double solid_mass_grams = 0, length_mm = 1, mass_unit_grams = 1;
  Moments solid = Moments::Zero();     ///< body units
  Moments fixed = Moments::Zero();     ///< shell, body units
  Moments interior = Moments::Zero();  ///< whole domain at unit density, body units
  std::string domain = "columns";      ///< or exact
  Grid grid;
  double wall = 0;                  ///< body units
  std::vector<Interval> intervals;  ///< of columns, in the order of the variables
  std::vector<ExactInterval> exact_intervals;
  std::size_t rays = 0;
  std::size_t inside_voxels = 0, interior_voxels = 0;  ///< of columns
  double solid_objective = 0;                          ///< f of the solid body, before anything is hollowed

  std::size_t variables = 0;  ///< of the last solve, where a formulation refines
  std::map<std::string, std::string> formulation_settings;  ///< in force, defaults included
  std::vector<Cube> cells;                                  ///< of an octree, in the order of the variables
  std::string scope;                                        ///< Problem::scope()
  Outcome outcome;                                          ///< of the last timed solve
  std::string infeasibility;                     ///< what cannot be met, when the outcome is infeasible
  std::string remedies;                          ///< and what would help
  std::optional<DeformationReport> deformation;  ///< when asked for; then all else is of the deformed body
  std::optional<Certificate> certificate;        ///< when asked for
  std::vector<Seconds> samples;                  ///< every timed solve
  Seconds median;                                ///< of each column of samples
  RoundingCost rounding;  ///< like `voids` and `verified` empty where config.part is none
  Voids voids;            ///< of the written part: model coordinates, mm
  Verified verified;
  double whole_seconds = 0;  ///< from the model to the verified file; without the certificate
  double peak_bytes = 0;     ///< of memory in use, of the whole process so far

  /// How far the objective may be above the least there is, as a share of it; infinite where nothing was
  /// proved, where the result misses its constraints by more than 1e-6, or where no interior meets the
  /// constraints. With a certificate only.
  [[nodiscard]] double gap() const;

  /// Body-frame moments in model units (g, mm) about the model's own origin and axes.
  [[nodiscard]] Moments model_moments(const Moments& body) const;
  /// The same in another frame of the same length.
  [[nodiscard]] Moments model_moments(const Moments& body, const Frame& about) const;
};

}  // namespace kreisel::core
