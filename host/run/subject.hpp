// subject.hpp - what a simulation looks at: a solid and the part that was made of it.
#pragma once

#include "session/result.hpp"

namespace kreisel::core {

/// In the body frame and units of the solid.
struct Subject {
  RunConfig config;                ///< of which problem, its settings and the device matter
  Body solid;                      ///< without its meshes, where those are not needed
  Moments part = Moments::Zero();  ///< with what fills its voids
  bool hollow = true;              ///< whether solid and part differ
};

/// Of a mesh, or the name of a model: the solid is what the outermost surfaces enclose, the part is the mesh
/// as it is.
/// @throws InputError  as make_body()
[[nodiscard]] Subject subject_of_mesh(const RunConfig& config, device::Device& device);

/// Of a solve that made a part. @throws InputError  as make_body()
[[nodiscard]] Subject subject_of_run(const RunResult& result, device::Device& device);

/// The same of numbers that are known of one.
struct SubjectNumbers {
  std::string name;
  double length_mm = 1, mass_unit_grams = 1;
  Moments solid = Moments::Zero(), part = Moments::Zero();  ///< body frame and units
};
[[nodiscard]] Subject subject_of_numbers(const RunConfig& config, const SubjectNumbers& numbers,
                                         device::Device& device);

}  // namespace kreisel::core
