// nested.hpp - shapes in each other, cut into parts that come apart.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "domain/columns.hpp"
#include "fabricate/verify.hpp"
#include "mesh/io/length_unit.hpp"
#include "run/nest_config.hpp"
#include "session/pipeline.hpp"
#include "session/provenance.hpp"

namespace kreisel::core {

struct NestedSpec {
  /// Of the kind NestLayers; its tolerances are the printer's.
  NestConfig config;
  std::optional<LengthUnit> unit;  ///< of the outermost shape, a file whose format has none; default mm
  Wall wall{2, Wall::percent};     ///< the least, mm or percent of the outermost shape's longest side
  std::filesystem::path file;      ///< where the parts go
  double density = 1;              ///< g/cm^3
  double peg_radius = 0;           ///< of pins that align the halves of each layer, mm; 0: none
  bool lay_flat = false;           ///< parts are written beside each other, halves on their cuts

  /// @throws std::bad_variant_access  a nesting of another kind
  [[nodiscard]] const NestLayers& layers() const { return std::get<NestLayers>(config.kind); }
  [[nodiscard]] NestLayers& layers() { return std::get<NestLayers>(config.kind); }
};

/// A shape around the next one, both halves of it as written and read again; mm.
struct NestedLayer {
  nest::Layer found;
  /// Least distance of the inner shape from the halves, on its way out of them too.
  double gap = std::numeric_limits<double>::infinity();
  /// Least thickness between the outer surface and what is carved out, at the corners of the latter.
  double wall = std::numeric_limits<double>::infinity();
};

struct NestedPart {
  WrittenMaterial written;  ///< layer-1-upper, layer-1-lower, layer-2-upper ... innermost
  std::size_t layer = 0;    ///< counted from the outside
  int half = -1;            ///< 0 or 1, above or below the cut; -1: neither, as the innermost shape or a peg
  TriangleMesh mesh;        ///< as read again, where it belongs; mm
  std::size_t shells = 0;   ///< pieces that it consists of
};

/// Shapes that nest, with the parts to print.
struct Nested {
  NestedSpec spec;
  Provenance provenance;
  std::vector<std::string> repairs;
  Vec3 up = Vec3::UnitZ();  ///< of the outermost shape
  double size = 0;          ///< its longest side, mm
  std::vector<NestedLayer> layers;
  std::vector<NestedPart> parts;
  std::string ended;  ///< why there are no more layers
  bool ok = false;    ///< every part is a solid, no gap below the accuracy, no wall below the least
  std::string text;
  double search_seconds = 0, parts_seconds = 0;

  [[nodiscard]] bool feasible() const { return !layers.empty(); }
  /// How far a part goes when all are taken apart, so that none hides another; mm.
  [[nodiscard]] Vec3 apart(const NestedPart& part) const;
};

/// Nests, carves, cuts, writes, reads again and measures. Where nothing nests nothing is written.
///
/// Each half is the half of its outer shape less what the inner one, thicker by the printer's accuracy,
/// sweeps on its way out of it (swept_void.hpp); the outer surface keeps its triangles. [Nest, s. 8]
///
/// @throws InputError   a shape that is no solid, options that do not fit, a file that cannot be written
/// @throws Interrupted  nothing is written
[[nodiscard]] Nested make_nested(const NestedSpec& spec, const Control& control = {});

/// As JSON, by the field names of docs/output.md.
[[nodiscard]] std::string to_json(const Nested& nested);

}  // namespace kreisel::core
