// remedies.hpp - what would make an infeasible task feasible.
#pragma once

#include <string>
#include <vector>

#include "problem/problem.hpp"
#include "session/config.hpp"
#include "session/pipeline.hpp"

namespace kreisel::core {

/// A change of the question that makes it feasible.
struct Remedy {
  std::string text;     ///< "a wall of 0.9 mm or less (now 1.2)"
  SettingTexts fields;  ///< what it sets, by the names of fields
};

/// Tries, one at a time and all else as it is: a thinner wall; voids (or, where those are the heavier, an
/// interior) of less density; an interior (or filling) of more; and parts of the interior of a heavier
/// material in place of voids; each to about a percent, by bisection on whether the moment solver finds a
/// filling of the exact domain that meets the constraints.
/// @return  those that help; one without fields says why none does
[[nodiscard]] std::vector<Remedy> remedies(const RunConfig& config, const Body& body, const Problem& problem,
                                           device::Device& device, const Control& control);

/// The same in one sentence.
[[nodiscard]] std::string what_would_help(const RunConfig& config, const Body& body, const Problem& problem,
                                          device::Device& device, const Control& control);

}  // namespace kreisel::core
