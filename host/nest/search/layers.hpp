// layers.hpp - one shape in another, and again in that, with walls between them that can be printed.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "nest/search/optimise.hpp"

namespace kreisel::core::nest {

/// What a printer needs, mm; it stays what it is however small the shapes become. [Nest, s. 8, fig. 12]
struct Tolerances {
  double accuracy = 0;  ///< sigma: how far a printed surface may be off, both ways; >= 0
  double wall = 0;      ///< epsilon: the least thickness that prints; >= 0

  /// How far inside the outer shape the inner one has to stay.
  [[nodiscard]] double inset() const { return accuracy + wall; }
};

struct LayersSpec {
  double size = 0;  ///< longest side of the outermost shape, mm; 0: as it is
  Tolerances tolerances;
  int most = 20;  ///< times that a shape is put into another, > 0
  /// Voxels along the longest side of what is offset, > 0. The offset errs by an eighth of a voxel, or by one
  /// along sharp edges, where it stays on the safe side.
  int cells = 192;
  /// For every layer anew. What is not free: the rotation and the directions are as given; the centroid is
  /// that of the space inside, and the plane goes through it. Keep-outs are balls in the outermost shape's
  /// coordinates, mm, and the outermost cut's alone.
  OptimiseSpec search;
  Optimiser optimise = nest::optimise;
};

/// One shape in the one outside it.
struct Layer {
  std::size_t outer = 0, inner = 0;  ///< which of the shapes
  double scale = 0;                  ///< of the inner shape's file
  double certified_scale = 0;        ///< of the same, by the exact test; 0: not even a smaller one
  double longest = 0;                ///< side of the inner shape, mm
  double ratio = 0;      ///< longest side of the inner shape over that of the outer one, each as in its file
  double thickness = 0;  ///< of the thinnest wall that is left when the inner one, thicker by the accuracy,
                         ///< is carved out along its ways; mm
  Cut cut;               ///< in the outermost shape's coordinates, mm; not in nesting units
  Eigen::Affine3d inner_to_world;  ///< from the inner file's coordinates to the outermost shape's, mm
  std::uint64_t evaluations = 0;
  double offset_seconds = 0, search_seconds = 0, certify_seconds = 0;
};

struct Layers {
  Eigen::Affine3d outermost;  ///< from the first file's coordinates to mm
  std::vector<Layer> layers;  ///< from the outside in
  std::string ended;          ///< why there are no more
  bool interrupted = false;
};

/// Told after every iteration of the search for a layer, which counts from 1; false ends everything.
using OnLayerIteration = std::function<bool(int layer, const SearchState& state)>;

/// Puts the second shape into the first, the third into that, and so on; the last one into itself until
/// nothing fits. Each layer is searched for on its own, in the outer shape's surface offset inwards, because
/// tolerances do not scale. It ends when the shape is too thin to hold a wall all around, when nothing that
/// nests is found, or when the inner shape would be thinner than a wall.
///
/// @param shapes  one or more closed meshes, the outermost first
/// @throws InputError  no shape, a tolerance or size out of range, a cavity where there are tolerances, and
/// as
///                     optimise()
[[nodiscard]] Layers nest_layers(const std::vector<TriangleMesh>& shapes, device::Device& device,
                                 const LayersSpec& spec, const OnLayerIteration& on_iteration = {});

/// The least distance between the surface of `outer` and what `inner` sweeps on its ways out, both in one
/// coordinate system: at the vertices of `inner`, and on their ways back to the cut at points at most `step`
/// apart.
[[nodiscard]] double clearance(const TriangleMesh& outer, const TriangleMesh& inner, const Cut& cut,
                               double step);

/// The same of one half: the part of `inner` on its side on its way, the rest where it is.
[[nodiscard]] double clearance_of_half(const TriangleMesh& outer, const TriangleMesh& inner, const Cut& cut,
                                       int half, double step);

}  // namespace kreisel::core::nest
