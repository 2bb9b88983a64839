// verify.hpp - judges a part by the file it was written to.
#pragma once

#include <filesystem>

#include "body/body.hpp"
#include "problem/problem.hpp"

namespace kreisel {

/// What a written file holds.
struct WrittenPart {
  Moments moments = Moments::Zero();  ///< body frame and units
  std::size_t triangles = 0;
  Verdict verdict;
};

/// Reads `file` again, checks that it is a watertight, oriented solid, integrates its moments on the host in
/// double (not by the kernels that made it) and asks the problem for its verdict. A mesh that fails the
/// checks gives a verdict that is not ok and says why.
[[nodiscard]] WrittenPart verify_file(const std::filesystem::path& file, const Body& body,
                                      const Problem& problem);

}  // namespace kreisel
