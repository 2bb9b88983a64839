// What each request of a desk does. [docs/live.md]
#include <fmt/format.h>

#include <utility>

#include "error.hpp"
#include "json_list.hpp"
#include "live/desk.hpp"
#include "live/make.hpp"
#include "live/motion_json.hpp"
#include "live/question.hpp"
#include "run/inspection_json.hpp"
#include "session/build_info.hpp"
#include "session/inspect.hpp"
#include "session/orientation_map.hpp"
#include "session/other_poses.hpp"
#include "session/remedies.hpp"
#include "stop.hpp"

namespace kreisel::core::live {
namespace {

/// Answers that are worth nothing any more when another question is asked.
const std::vector<std::string_view> on_the_way = {"help", "map"};

}  // namespace

void Desk::hello(Request request) {
  const std::vector<std::string> models = names_of(*setup_);
  send_(message({{"do", "hello"},
                 {"id", request.id()},
                 {"version", build_info::version},
                 {"commit", build_info::commit},
                 {"model", first_of(*setup_)},
                 {"models", models},
                 {"requests", names()},
                 {"problems", problems_json()},
                 {"fields", fields_json(open_fields(), setup_->usual)},
                 {"part_fields", fields_json(part_fields(), PartSpec())},
                 {"nest_fields", fields_json(nest_fields("swarm"), usual_nesting("swarm"))},
                 {"sliced", !setup_->slicing.slicer.empty()},
                 {"largest_mesh", setup_->limits.mesh_bytes}}));
}

void Desk::open(Request request) {
  RunConfig config = setup_->usual;
  set_fields(config, request.fields("fields"), body_fields());
  const nlohmann::json id = request.id();
  const bool sent = request.yes("sent");
  const std::string name = request.text("model");
  const auto bytes = std::make_shared<std::string>(std::move(request.bytes));
  put(answering_, "open", id, [this, id, name, bytes, sent, said = config.body](const Worker::Turn& turn) {
    const StopScope scope(turn.closed);
    answers_.reset();
    show(id, sent ? open_sent(*setup_, name, std::move(*bytes), said) : open_named(*setup_, name, said));
  });
}

/// The solid first, so that it can be asked about; what else is known of the mesh follows.
void Desk::show(const nlohmann::json& id, Opened opened) {
  const std::string trouble = trouble_of([&] { make_solid(opened); });
  const auto shared = std::make_shared<const Opened>(std::move(opened));
  {
    const std::lock_guard lock(mutex_);
    opened_ = shared->solid ? shared : nullptr;
    nestings_ = nullptr;
  }
  if (shared->solid)
    answers_ = std::make_unique<Answers>(shared->solid, shared->spec.model, setup_->device(), send_);
  send_(message({{"do", "opened"},
                 {"id", id},
                 {"model", shared->spec.model},
                 {"triangles", shared->mesh->mesh.triangles.size()},
                 {"trouble", trouble}}));
  put(working_, "inspect", id, [this, id, shared](const Worker::Turn& turn) {
    nlohmann::json seen = json_of(inspect(*shared->mesh, shared->spec, {turn.closed, {}}));
    seen.update({{"do", "inspected"}, {"id", id}, {"model", shared->spec.model}});
    send_(message(seen));
  });
}

RunConfig Desk::question_of(const Request& request) const {
  RunConfig config = setup_->usual;
  set_fields(config, request.fields("question"), open_fields());
  return config;
}

void Desk::ask(Request request) {
  const RunConfig question = question_of(request);
  const bool moving = request.yes("moving");
  working_.give_up(on_the_way);
  put(answering_, "ask", request.id(), [this, id = request.id(), question, moving](const Worker::Turn& turn) {
    if (!answers_) throw InputError("a question without a body; expected \"open\" first");
    answers_->ask(id, question, moving, turn);
  });
}

Session& Desk::workbench(RunConfig& question) {
  std::shared_ptr<const Opened> opened;
  {
    const std::lock_guard lock(mutex_);
    opened = opened_;
  }
  if (!opened) throw InputError("a question without a body; expected \"open\" first");
  question.body.model = opened->spec.model;
  if (on_bench_ != opened) {
    bench_.emplace(opened->solid, std::make_shared<device::Device>(setup_->device().with_own_queue()));
    on_bench_ = opened;
  }
  return *bench_;
}

void Desk::make(Request request) {
  PartSpec spec;
  spec.config = question_of(request);
  set_fields(spec, request.fields("part"), part_fields());
  spec.print.slicing = setup_->slicing;
  const nlohmann::json id = request.id();
  working_.give_up(on_the_way);
  put(working_, "make", id, [this, id, spec](const Worker::Turn& turn) mutable {
    Session& session = workbench(spec.config);
    live::make(id, session, std::move(spec), send_, turn.closed);
  });
}

/// What would make a question feasible: changes of it, and other poses in words of the command line.
void Desk::help(Request request) {
  const nlohmann::json id = request.id();
  put(working_, "help", id, [this, id, question = question_of(request)](const Worker::Turn& turn) mutable {
    Session& session = workbench(question);
    const Control control{turn.closed, {}};
    const Stages stages = session.stages(question, control);
    nlohmann::json help = {{"do", "help"}, {"id", id}, {"remedies", nlohmann::json::array()}};
    if (stages.problem->impossible().empty())
      for (const Remedy& remedy : remedies(question, *stages.body, *stages.problem, *stages.device, control))
        help["remedies"].push_back({{"text", remedy.text}, {"fields", remedy.fields}});
    help["poses"] = "";
    send_(message(help));
    help["poses"] = other_poses(session, question, stages.pose->axis, control);
    send_(message(help));
  });
}

/// In which directions it can be done.
void Desk::map(Request request) {
  const nlohmann::json id = request.id();
  put(working_, "map", id, [this, id, question = question_of(request)](const Worker::Turn& turn) mutable {
    Session& session = workbench(question);
    MapRun run(question);
    run.axes = 500;
    MapSpec spec = map_spec(run);
    if (const auto& cases = find_problem(run.problem).map; cases && !cases->setting.empty()) {
      const SettingTexts settings = settings_of(run, "problem");
      const auto given = settings.find(cases->setting);
      spec.drafts = {given == settings.end() ? cases->usual : given->second};
    }
    const OrientationMap found = map_orientations(session, spec, {turn.closed, {}});
    nlohmann::json map = {
        {"do", "map"}, {"id", id}, {"axes", nlohmann::json::array()}, {"ok", nlohmann::json::array()}};
    for (std::size_t i = 0; i < found.axes.size(); ++i) {
      map["axes"].push_back(json_list(found.axes[i]));
      map["ok"].push_back(found.at(i, 0).verdict.ok);
    }
    send_(message(map));
  });
}

/// What the solid and the part do when they are left to themselves.
void Desk::move(Request request) {
  const nlohmann::json id = request.id();
  working_.give_up(on_the_way);
  put(working_, "move", id, [this, id, question = question_of(request)](const Worker::Turn& turn) mutable {
    constexpr double seconds = 2;  // of a spin
    Session& session = workbench(question);
    const Control control{turn.closed, {}};
    SolvedRun run(session, question, control);
    run.solve(control);
    if (!run.result.outcome.converged())
      throw InputError(fmt::format("nothing to set in motion: {}", run.result.infeasibility));
    SimulationSpec spec;
    spec.spin.seconds = seconds;
    const Subject subject{run.result.config, run.body(), run.result.outcome.moments, true};
    nlohmann::json motion =
        motion_json(simulate(subject, spec, *run.stages().device, control), run.body().frame);
    motion.update({{"do", "motion"}, {"id", id}});
    send_(message(motion));
  });
}

void Desk::stop(Request) { working_.stop(); }

}  // namespace kreisel::core::live
