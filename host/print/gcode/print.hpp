// print.hpp - what a G-code file prints: moments by type, tool, object and layer.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "body/moments.hpp"
#include "geometry/box.hpp"
#include "kreisel/mesh.hpp"

namespace kreisel::core {

using kreisel::Vec3;

/// What one tool prints with.
struct Filament {
  double diameter = 1.75, density = 1;                   ///< mm; g/cm^3
  bool diameter_assumed = true, density_assumed = true;  ///< neither the file nor the user says it
};

/// Everything of one type, tool and object. Coordinates of the bed, mm.
struct PrintGroup {
  std::string type;    ///< in the slicer's words; empty: it does not say
  std::string object;  ///< its label; empty: none
  int tool = 0;
  bool of_part =
      true;  ///< not skirt, brim, raft, support, tower, purge, nor what a machine does first and last
  double density = 1;                 ///< of its filament, g/cm^3
  Moments moments = Moments::Zero();  ///< at density 1: mm^3, mm^4, mm^5

  [[nodiscard]] double volume() const { return moments[S1]; }              ///< mm^3
  [[nodiscard]] Moments mass() const { return 1e-3 * density * moments; }  ///< g, g mm, g mm^2
};

/// What of the part is in one layer.
struct PrintLayer {
  double z = 0;                    ///< of the nozzle where it began
  double volume = 0;               ///< mm^3
  Moments mass = Moments::Zero();  ///< g, g mm, g mm^2
};

/// What has a label of its own, or all that has none.
struct PrintObject {
  std::string label;         ///< may be empty
  Vec3 foot = Vec3::Zero();  ///< middle of what of it is lowest
};

struct Print {
  std::string slicer;  ///< with its version; empty: the file does not say
  std::size_t bytes = 0, lines = 0;
  std::vector<Filament> filaments;   ///< of each tool
  std::vector<PrintGroup> groups;    ///< in the order in which they began
  std::vector<PrintLayer> layers;    ///< as they are printed
  std::vector<PrintObject> objects;  ///< that have any of the part, in the order in which they began
  Box part;                          ///< around the nozzle's paths of the part
  std::optional<double> used_mm;     ///< of filament, by the slicer's own account

  /// Of all that `wanted` says: mm^3, and in grams.
  template <class Wanted>
  [[nodiscard]] double volume(const Wanted& wanted) const {
    double sum = 0;
    for (const PrintGroup& group : groups)
      if (wanted(group)) sum += group.volume();
    return sum;
  }
  template <class Wanted>
  [[nodiscard]] Moments mass(const Wanted& wanted) const {
    Moments sum = Moments::Zero();
    for (const PrintGroup& group : groups)
      if (wanted(group)) sum += group.mass();
    return sum;
  }
  /// The part, all objects together.
  [[nodiscard]] double part_volume() const { return volume(of_part); }
  [[nodiscard]] Moments part_mass() const { return mass(of_part); }

 private:
  static bool of_part(const PrintGroup& group) { return group.of_part; }
};

}  // namespace kreisel::core
