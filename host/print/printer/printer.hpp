// printer.hpp - printers that are known: how large a part they take, and how fine.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

struct Printer {
  std::string name;
  std::vector<std::string> also = {};      ///< other names
  std::vector<Eigen::Vector2d> bed = {};   ///< corners of it, mm; convex
  double height = 0;                       ///< mm
  std::vector<double> nozzles = {};        ///< mm, the usual one first
  double least_layer = 0, most_layer = 0;  ///< mm, of that; 0: not said
  std::string source = {};                 ///< who says so

  /// Whether all of a part is over the bed and below the top. @param laid  mesh, coordinates of the bed
  [[nodiscard]] bool holds(const TriangleMesh& laid) const;
  [[nodiscard]] Box box() const;
  /// "250 x 210 x 200 mm".
  [[nodiscard]] std::string size_text() const;
  /// As profiles of PrusaSlicer have it: "0x0,250x0,...".
  [[nodiscard]] std::string bed_text() const;
};

/// Of a file of PrusaSlicer's, one for each model that lays filament; others, and what is not whole, are left
/// out. @param source  that is said of them
[[nodiscard]] std::vector<Printer> printers_of_slicer(std::string_view text, const std::string& source);

/// Those of newer.ini, then those that PrusaSlicer has installed profiles of, here or for the user.
[[nodiscard]] const std::vector<Printer>& printers();

/// @param name  as printers() have it, in any case, or a part of one name alone; and @0.6 for another nozzle,
///              which then is the first
/// @throws InputError  none of that name: the nearest; several; a nozzle that it does not have
[[nodiscard]] Printer find_printer(std::string_view name);

/// newer.ini, embedded.
extern const char* const newer_printers;

}  // namespace kreisel::core
