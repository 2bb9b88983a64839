#include "session/pipeline.hpp"

#include <fmt/format.h>

#include <utility>

#include "error.hpp"
#include "session/make_part.hpp"

namespace kreisel::core {

RunOutput run(const RunConfig& config, const std::string& mesh_file, const Control& control) {
  if (config.part == Part::none && !mesh_file.empty())
    throw InputError(
        fmt::format("part = none with the mesh {}; expected no mesh, or part = written", mesh_file));
  Session session;
  SolvedRun solved(session, config, control);
  solved.complete(control);
  PartMeshes part{solved.body().mesh, {}};
  if (config.part == Part::written) {
    control.tell("round, extract, verify");
    part = make_part(solved, mesh_file);
  }
  return {std::move(solved.result), std::move(part.outer), std::move(part.cavity)};
}

}  // namespace kreisel::core
