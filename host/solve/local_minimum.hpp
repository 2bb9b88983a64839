// local_minimum.hpp - whether what a solve ends with is a minimum at all.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "body/moments.hpp"

namespace kreisel::core {

/// Is f larger for all other fillings whose moments are near and meet the constraints? By a condition of
/// second order [docs/quadric.md, s. 3]; the first to give one were Hafner, Ly, Wojtan 2024.
struct LocalMinimum {
  enum class Answer { no, yes, undecided };
  Answer strict = Answer::undecided;
  /// Of f's second variation on the tangent space, measured by the growth of q . s: 1 where f has no
  /// curvature of its own, 0 where the minimum is no longer strict. NaN: the tangent space is {0}, or nothing
  /// is known of it.
  double smallest = std::numeric_limits<double>::quiet_NaN();
  int dimension = 0;                    ///< of the tangent space
  Moments direction = Moments::Zero();  ///< how q changes along the eigenvector; zero without one
  std::string why;                      ///< it is undecided, or what to do about a no

  /// "yes, smallest eigenvalue 0.71 on the tangent space of 5 dimensions".
  [[nodiscard]] std::string text() const;
};

/// The name used in files: yes, no, undecided.
[[nodiscard]] std::string_view to_string(LocalMinimum::Answer answer);

}  // namespace kreisel::core
