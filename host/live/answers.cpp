#include "live/answers.hpp"

#include <algorithm>
#include <utility>

#include "error.hpp"
#include "live/answer_json.hpp"
#include "stop.hpp"
#include "stopwatch.hpp"

namespace kreisel::core::live {
namespace {

constexpr int coarse_cells = 40;  // along the longest side, while a hand moves
constexpr double gap = 1e-3;      // that is to be proved

Session session_of(const std::shared_ptr<const Source>& solid, const device::Device& device) {
  return {solid, std::make_shared<device::Device>(device.with_own_queue())};
}

}  // namespace

Answers::Answers(std::shared_ptr<const Source> solid, std::string model, const device::Device& device,
                 Send send)
    : solid_(std::move(solid)),
      model_(std::move(model)),
      send_(std::move(send)),
      fine_(session_of(solid_, device)),
      coarse_(session_of(solid_, device)),
      own_rays_(session_of(solid_, device)),
      picture_(send_) {}

Answers::Costly Answers::costly(const RunConfig& question) {
  BodySpec shaped;
  if (question.body.shaped_along_axis()) shaped = question.body;
  shaped.size = question.body.size;
  return {question.wall, question.grid, shaped};
}

void Answers::ask(const nlohmann::json& id, RunConfig question, bool moving, const Worker::Turn& turn) {
  const Stopwatch whole;
  question.body.model = model_;
  const bool coarse = moving && laid_ != costly(question) && question.grid.resolution > coarse_cells;
  if (coarse) question.grid = {.resolution = coarse_cells, .cells = {}};
  Session& session = coarse ? coarse_ : fine_;
  const Control control{turn.closed, {}};
  SolvedRun run(session, question, control, Along::any_axis);
  if (!coarse) laid_ = costly(question);
  const std::vector<std::string_view> made = session.made();
  run.decide(control);
  nlohmann::json answer = answer_json(run);
  answer.update({{"do", "answer"}, {"id", id}, {"moving", moving}, {"coarse", coarse}, {"made", made}});
  answer["seconds"]["all"] = whole.seconds();
  picture_.show_body(run.body().mesh);  // ahead of what is drawn on it
  send_(message(answer, "answer"));
  picture_.show_offset(run.result.wall * run.result.length_mm, moving);
  if (moving) return;
  const StopScope scope(turn.newer);
  if (run.result.outcome.converged()) certify(id, question, turn);
  if (run.result.outcome.termination == Termination::infeasible) {  // why takes as long as many answers
    run.explain({turn.newer, {}});
    send_(message({{"do", "unmet"}, {"id", id}, {"text", run.result.infeasibility}}, "unmet"));
  }
}

/// Certificates know problems in the frame of their own rays alone.
void Answers::certify(const nlohmann::json& id, const RunConfig& question, const Worker::Turn& turn) {
  const Control control{turn.newer, {}};
  RunConfig asked = question;
  asked.certify = gap;
  SolvedRun run(own_rays_, asked, control, Along::own_axis);
  run.decide(control);
  if (!run.result.outcome.converged()) return;
  run.certify(control);
  nlohmann::json found = certificate_json(run.result);
  found.update({{"do", "certificate"}, {"id", id}});
  send_(message(found, "certificate"));
}

}  // namespace kreisel::core::live
