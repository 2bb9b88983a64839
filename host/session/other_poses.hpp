// other_poses.hpp - in which poses a body can do what it cannot in the one that was asked for.
#pragma once

#include <string>

#include "session/config.hpp"
#include "session/session.hpp"

namespace kreisel::core {

/// As options of a command line, of the poses that an `auto` would try: how many will do, the one nearest to
/// the one asked for, and the best; of the settings that can be `auto`, those that help in the same pose; and
/// where what it rests on is asked for, the least to cut off its bottom. Empty for a problem whose pose is
/// part of the question. [docs/poses.md]
/// @param asked  the direction that will not do, of length 1, model coordinates
[[nodiscard]] std::string other_poses(Session& session, const RunConfig& config, const Vec3& asked,
                                      const Control& control);

}  // namespace kreisel::core
