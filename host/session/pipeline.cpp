#include "session/pipeline.hpp"

#include <fmt/format.h>

#include <utility>

#include "error.hpp"
#include "session/find_pose.hpp"
#include "session/make_part.hpp"

namespace kreisel::core {

namespace {

/// The question in the best pose, where one is to be found. @param none  why there is none
RunConfig settled(Session& session, const RunConfig& config, std::string& none, const Control& control) {
  if (!leaves_open(config)) return config;
  const FoundPoses found = find_poses(session, config, control);
  RunConfig usual = in_usual_pose(config);
  if (found.good.empty()) {
    none = found.text();
    usual.body.stem = {};  // it may be what cannot be had
    return usual;
  }
  return posed(config, found.good.front());
}

}  // namespace

RunOutput run(const RunConfig& config, const std::string& mesh_file, const Control& control) {
  if (config.part == Part::none && !mesh_file.empty())
    throw InputError(
        fmt::format("part = none with the mesh {}; expected no mesh, or part = written", mesh_file));
  Session session;
  std::string none;
  SolvedRun solved(session, settled(session, config, none, control), control);
  if (!none.empty()) {
    solved.result.outcome.termination = Termination::infeasible;
    solved.result.outcome.message = "no pose will do";
    solved.result.infeasibility = none;
    return {std::move(solved.result), solved.body().mesh, {}};
  }
  solved.complete(control);
  PartMeshes part{solved.body().mesh, {}};
  if (config.part == Part::written) {
    control.tell("round, extract, verify");
    part = make_part(solved, mesh_file);
  }
  return {std::move(solved.result), std::move(part.outer), std::move(part.cavity)};
}

}  // namespace kreisel::core
