// published.hpp - a paper's own numbers, read from results/published.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace kreisel::core {

/// One row of a published table; what the table has not is empty.
struct PublishedRow {
  struct Side {
    int variables = 0;
    double seconds = 0;
  };
  /// Inertia about the centre of mass as printed: Ixx Iyy Izz Ixy Iyz Ixz, unit unknown.
  struct Inertia {
    std::array<double, 6> before{}, after{};
  };
  /// Height of the centre of mass, per cent of the body's, and the tilt at which it topples.
  struct Standing {
    double height_percent = 0, tilt_degrees = 0;
  };
  /// Pieces of the void, and planar cuts to get at them.
  struct Voids {
    int pieces = 0, cuts = 0;
  };
  /// Of both shapes together; a feasibility test, a scale search, all of an optimisation.
  struct Nesting {
    int triangles = 0;
    double test_ms = 0, search_ms = 0, seconds = 0, scale = 0;
  };
  std::string model;                       ///< as this project names it; the file says how the paper does
  std::optional<std::array<int, 3>> grid;  ///< cells along x, y, z
  std::string problem;                     ///< empty: the paper's only one
  std::string label, solver;               ///< of a run; empty: any
  std::optional<Side> rayrep, voxel;
  std::optional<double> speedup;                ///< as printed there, from times that were not rounded
  std::optional<double> seconds;                ///< of a solve, where that is all there is
  std::optional<double> omega_reduction;        ///< least speed of a stable spin, solid over optimised
  std::map<std::string, std::string> settings;  ///< of the run that the row belongs to, such as problem.lower
  std::optional<Inertia> inertia;
  std::optional<Standing> standing;
  std::optional<Voids> voids;
  std::optional<Nesting> nesting;
};

struct Published {
  std::string source, machine;
  std::vector<PublishedRow> rows;

  /// The first row of that model, grid, problem and settings, or nullptr. A row without a grid fits every
  /// grid, one without a problem every problem, without settings all. @param grid  empty: unknown, fits rows
  /// without one
  [[nodiscard]] const PublishedRow* find(const std::string& model,
                                         const std::optional<std::array<int, 3>>& grid,
                                         const std::string& problem = {},
                                         const std::map<std::string, std::string>& settings = {}) const;
};

/// @throws InputError  unreadable, not JSON, or a field missing or of another type; names file and fault
[[nodiscard]] Published read_published(const std::filesystem::path& file);

}  // namespace kreisel::core
