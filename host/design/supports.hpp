// supports.hpp - what supports a print would need inside closed voids, and which way up they are least.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "design/print_pieces.hpp"
#include "print/slice/slice.hpp"

namespace kreisel::core {

/// mm^3 of supports where a slicer may put them everywhere.
struct Supports {
  double in_voids = 0;  ///< that nobody can take out: more than the same part needs when it is solid
  double in_all = 0;
};

/// Slices the part with supports everywhere, and once more without its voids.
/// @param outer, cavity  model coordinates, mm; normals out of the material  @param up  any length but zero
/// @return  nothing of a slicer that cannot be told to
/// @throws InputError  as MeshSlicer  @throws Interrupted
[[nodiscard]] std::optional<Supports> measure_supports(const MeshSlicer& slice, const TriangleMesh& outer,
                                                       const TriangleMesh& cavity, const Vec3& up,
                                                       const Control& control);

/// The same of all pieces of a part that have voids, each as it is printed; nothing, too, where none has.
[[nodiscard]] std::optional<Supports> measure_supports(const MeshSlicer& slice,
                                                       const std::vector<PrintPiece>& pieces,
                                                       const Control& control);

/// mm^3 below the ceilings of a surface, down to what is below them or to the lowest point: what supports
/// would fill. A ceiling is what hangs over by more than 45 degrees.
/// @param surface  closed, normals out of the material  @param up  of length 1
[[nodiscard]] double below_ceilings(const TriangleMesh& surface, const Vec3& up);

struct UpTried {
  Vec3 up;
  Supports supports;
};

/// Which way up supports in voids are least; where there are no voids, supports at all.
struct FoundUp {
  Vec3 up;
  int directions = 0;           ///< looked at
  std::vector<UpTried> sliced;  ///< the best few of them, and the usual one
};

/// @param usual  is tried, too  @param fits  which directions are looked at
/// @throws InputError  a slicer that cannot be told to make supports everywhere; as MeshSlicer
/// @throws Interrupted
[[nodiscard]] FoundUp find_up(const MeshSlicer& slice, const TriangleMesh& outer, const TriangleMesh& cavity,
                              const Vec3& usual, const std::function<bool(const Vec3&)>& fits,
                              const Control& control);

}  // namespace kreisel::core
