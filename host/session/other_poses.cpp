#include "session/other_poses.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/units.hpp"
#include "session/find_pose.hpp"

namespace kreisel::core {
namespace {

/// What of the candidate's question is not in the one that was asked.
std::string options_of(const RunConfig& config, const PoseCandidate& candidate) {
  const RunConfig question = posed(config, candidate);
  std::string words;
  const auto add = [&](const char* option, const std::optional<Vec3>& v, int digits) {
    if (v)
      words += fmt::format(" --{} {:.{}f},{:.{}f},{:.{}f}", option, (*v)[0], digits, (*v)[1], digits, (*v)[2],
                           digits);
  };
  if (config.free) {
    add("axis", question.body.axis, 4);
    add("up", question.body.up, 4);
    add("contact", question.body.contact, 3);
  }
  if (question.body.stem.radius && !config.body.stem.radius)
    words += fmt::format(" --stem {:.3g}", *question.body.stem.radius);
  for (const auto& [name, value] : find_problem(config.problem).settings.changed(candidate.settings)) {
    const auto before = config.settings.find("problem." + name);
    if (before == config.settings.end() || before->second != value)
      words += fmt::format(" --{} {}", name, value);
  }
  if (candidate.flatten) words += fmt::format(" --flatten {:.3g}", *candidate.flatten);
  return words.empty() ? words : words.substr(1);
}

double angle_between(const Vec3& a, const Vec3& b) { return std::acos(std::clamp(a.dot(b), -1.0, 1.0)); }

/// The question with that left open, and what is found.
std::string opened(Session& session, const RunConfig& open, const Vec3& asked, const Control& control) {
  const FoundPoses found = find_poses(session, open, control);
  if (found.good.empty()) return found.text();
  const auto nearest = std::ranges::min_element(found.good, {}, [&](const PoseCandidate& candidate) {
    return angle_between(candidate.direction, asked);
  });
  std::size_t good = 0, tried = 0;
  for (const PosesTried& kind : found.tried) good += kind.good, tried += kind.tried;
  const bool upright = find_problem(open.problem).upright;
  std::string words =
      fmt::format("{} of {} other {} will do: the nearest, {:.0f} degrees off, {}", good, tried,
                  upright ? "poses" : "axes", degrees(angle_between(nearest->direction, asked)),
                  options_of(open, *nearest));
  if (nearest != found.good.begin())
    words += fmt::format("; the best {}", options_of(open, found.good.front()));
  return words;
}

}  // namespace

std::string other_poses(Session& session, const RunConfig& config, const Vec3& asked,
                        const Control& control) {
  const ProblemEntry& entry = find_problem(config.problem);
  if (entry.poses == Poses::none) return {};
  std::vector<std::string> help;
  RunConfig open = in_usual_pose(config);
  if (entry.choices) {
    const std::shared_ptr<const Body> body = session.stages(open, control).pose;
    // In the same pose, with what else may be chosen.
    RunConfig here = open;
    if (!entry.chosen.empty()) here.settings["problem." + entry.chosen] = "auto";
    const FoundPoses found = find_poses(session, here, control);
    if (!found.good.empty()) help.push_back(options_of(open, found.good.front()));
  }
  if (entry.poses == Poses::any) {
    // In the same pose, of denser material where any is left: aluminium, steel, lead.
    for (const double density : {2.7, 7.85, 11.3}) {
      RunConfig ballast = open;
      if (density <= std::max(open.body.interior_density.value_or(open.body.density), open.body.void_density))
        continue;
      ballast.body.interior_density = density;
      if (find_poses(session, ballast, control).good.empty()) continue;
      help.push_back(fmt::format("--interior-density {}", density));
      break;
    }
  }
  if (entry.poses == Poses::rest && !config.body.flatten) {
    RunConfig cut = open;
    cut.flatten = true;
    const FoundPoses found = find_poses(session, cut, control);
    if (!found.good.empty()) help.push_back(options_of(open, found.good.front()));
  }
  open.free.emplace();
  help.push_back(opened(session, open, asked, control));
  return fmt::format("{}", fmt::join(help, "; or "));
}

}  // namespace kreisel::core
