// inspection.hpp - everything about a mesh: what is wrong with it, what is mended, what it weighs as a solid.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kreisel/export.hpp"
#include "kreisel/mending.hpp"
#include "kreisel/mesh.hpp"
#include "kreisel/verdict.hpp"

namespace kreisel {

/// Connected triangles, after the repairs.
struct ShellReport {
  std::size_t triangles = 0;
  bool closed = false;
  long euler = 0;            ///< Euler characteristic
  std::optional<int> genus;  ///< where it is closed
  double volume = 0;         ///< enclosed, units of the file; negative: inside out
  std::size_t depth = 0;     ///< how many shells are around it
};

/// A way of lying that is stable.
struct RestReport {
  Vec3 up;                  ///< of length 1
  double probability = 0;   ///< that it ends so, dropped from any orientation alike without a bounce
  double tilt_degrees = 0;  ///< by which it topples
  double area = 0;          ///< of what carries it, mm^2
};

/// A solid at rest in model coordinates: mm, g.
struct SolidReport {
  Vec3 extent, centre;  ///< of the bounding box; of mass
  double volume = 0, mass = 0;
  Vec3 principal;                 ///< moments of inertia about the centre of mass, g mm^2, ascending
  Eigen::Matrix3d axes;           ///< columns, in that order
  std::vector<double> pieces;     ///< mass of each that touches no other, g, the heaviest first
  std::vector<RestReport> rests;  ///< the most probable first; `--up rest:N` takes the N-th
  std::map<std::string, Verdict> verdicts;  ///< what each problem says of it as it is
};

struct Inspection {
  std::string format;                         ///< in words
  std::size_t vertices = 0, triangles = 0;    ///< as read
  std::map<std::string, std::size_t> checks;  ///< how many of each fault; names as in docs/output.md
  /// Two triangles that run through each other, after the repairs, counted from 0; nothing where none do.
  std::optional<std::array<std::size_t, 2>> first_crossing;
  std::vector<std::string> repairs;  ///< what was mended, one line each
  std::vector<ShellReport> shells;
  std::string error;                 ///< why it bounds no solid; empty: it does
  std::optional<SolidReport> solid;  ///< where it does
};

/// Needs no device. @param mm_per_unit  of formats that do not say  @param density  g/cm^3
/// @param mending  what is allowed to make it a solid
/// @throws InputError  no readable file; that it bounds no solid is an answer (`error`)
[[nodiscard]] KREISEL_API Inspection inspect(const std::filesystem::path& file, double mm_per_unit = 1,
                                             double density = 1, const Mending& mending = {});
/// The same of a mesh in memory, mm.
[[nodiscard]] KREISEL_API Inspection inspect(Mesh mesh, double density = 1, const Mending& mending = {});

}  // namespace kreisel
