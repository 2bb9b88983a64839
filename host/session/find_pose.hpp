// find_pose.hpp - the pose in which a body does best what is asked of it. [docs/poses.md]
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/session.hpp"

namespace kreisel::core {

/// A pose with what an `auto` found to go with it.
struct PoseCandidate {
  Vec3 direction;               ///< of length 1, model coordinates: up or axis
  std::optional<Vec3> contact;  ///< of an axis, mm
  Through through = Through::lowest;
  Settings settings;              ///< of the problem
  std::optional<double> flatten;  ///< mm
  std::optional<double> stem;     ///< radius of one that nobody asked for, mm
  double loss = 0;                ///< Problem::pose_loss() on the coarse domain of the search
};

/// Poses of one kind that were tried, and what became of them.
struct PosesTried {
  std::string what;    ///< "axes through the lowest point"
  double spacing = 0;  ///< degrees between neighbours; 0: all that there are
  std::size_t tried = 0, infeasible = 0, undecided = 0;
  std::size_t impossible = 0;  ///< whatever is inside, as to stand where it does not rest
  std::size_t good = 0;        ///< whose optimum does what was asked
  std::size_t unjoined = 0;    ///< of the best of those: where no stem can be joined

  [[nodiscard]] std::string text() const;
};

/// The poses that are left open, tried over one coarse domain.
struct FoundPoses {
  std::vector<PoseCandidate> good = {};  ///< whose optimum there does what was asked, the best first
  std::vector<PosesTried> tried = {};
  /// What is still to be tried where none of these makes a part that does it.
  std::optional<RunConfig> onward = {};
  /// A sentence on how many were tried, how far apart, and why none of the others will do.
  [[nodiscard]] std::string text() const;
};

/// Poses the body in every way that the question leaves open.
///
/// Poses::any: directions spread over the sphere, and those that bodies are made for: the solid's principal
/// axes, the normals of what it can lie on; from the best of them then finer ones. An axis runs through the
/// lowest point along it; where none of those will do, through the centre of mass, on a stem that is then
/// made. Poses::rest: what it can lie on. Each pose with each of the problem's choices of settings.
/// @param config  that leaves_open()
/// @throws InputError   a problem whose pose is part of the question; rest:N of fewer
/// @throws Interrupted
[[nodiscard]] FoundPoses find_poses(Session& session, const RunConfig& config, const Control& control);

/// The question in that pose.
[[nodiscard]] RunConfig posed(const RunConfig& config, const PoseCandidate& candidate);

/// The question as it is where nothing is found: in the body's usual pose, settings that are `auto` by
/// default.
[[nodiscard]] RunConfig in_usual_pose(RunConfig config);

/// Whether the question leaves something to be found.
[[nodiscard]] bool leaves_open(const RunConfig& config);

}  // namespace kreisel::core
