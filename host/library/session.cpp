#include "kreisel/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "design/design.hpp"
#include "library/config_of.hpp"
#include "library/state.hpp"
#include "session/find_pose.hpp"
#include "session/orientation_map.hpp"
#include "session/other_poses.hpp"
#include "session/remedies.hpp"
#include "session/solved_run.hpp"

namespace kreisel {
namespace {

using core::RunResult;

Solution::End end_of(core::Termination termination) {
  switch (termination) {
    case core::Termination::optimal:
      return Solution::End::optimal;
    case core::Termination::acceptable:
      return Solution::End::acceptable;
    case core::Termination::infeasible:
      return Solution::End::infeasible;
    case core::Termination::failed:
    case core::Termination::interrupted:
      break;
  }
  return Solution::End::failed;
}

/// Of x in the frame of the rays, in that of the question: q(x) is one number, whatever frame x is given in.
Moments quadric_in(const core::Frame& to, const core::Frame& from, const std::vector<double>& x) {
  const Moments q(x.data());
  const Eigen::Matrix3d R = to.rotation * from.rotation.transpose();
  const core::Matrix10 map = core::moment_map(R, to.to_body(from.origin));
  return map.transpose().partialPivLu().solve(q);
}

/// What cannot be met, one by one: parts between "; ".
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find("; ", at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 2;
  }
  return parts;
}

Solution solution_of(const Question& question, const core::SolvedRun& run) {
  const RunResult& r = run.result;
  const core::Frame& frame = run.stages().pose->frame;
  Solution s;
  s.question = question;
  s.end = end_of(r.outcome.termination);
  s.message = r.outcome.message;
  s.objective = r.outcome.objective;
  s.violation = r.outcome.violation;
  s.moments = r.model_moments(r.outcome.moments);
  s.variables = r.outcome.x;
  if (run.stages().formulation->name() == "quadric") s.quadric_body = quadric_in(frame, r.frame, r.outcome.x);
  if (r.certificate && std::isfinite(r.certificate->bound)) s.bound = r.certificate->bound;
  if (const auto& d = r.deformation)
    s.deformation = Deformation{std::string(core::to_string(d->reached)),
                                d->largest_mm,
                                d->largest_percent,
                                d->where,
                                d->volume_before,
                                d->volume_after,
                                d->least_determinant,
                                d->before,
                                run.body().mesh};
  s.unmet = parts_of(r.infeasibility);
  if (s.feasible()) s.verdict = run.problem().verify(r.outcome.moments, r.length_mm);
  s.rotation = frame.rotation;
  s.origin = frame.origin;
  s.length_mm = frame.length;
  s.setup_seconds = r.median.setup;
  s.solve_seconds = r.median.solve;
  return s;
}

}  // namespace

Device::Device(const std::string& selector)
    : state_(
          translated([&] { return std::make_shared<const State>(State{core::device::Device(selector)}); })) {}

std::string Device::name() const { return state_->device.info().name; }

Session::Session(Body body, const Device& device)
    : state_(translated([&] {
        auto own = std::make_shared<core::device::Device>(device.state_->device.with_own_queue());
        return std::make_unique<State>(body.state_, std::move(own));
      })) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

namespace {

/// Members say how it lies, and nothing else does.
void forget_direction(Question& question) {
  question.pose.find.clear();
  for (const char* name : {"axis", "up", "contact", "axis-through"}) question.fields.erase(name);
}

/// The question in the pose that was found for it.
Question in_pose(Question question, const core::RunConfig& found) {
  forget_direction(question);
  question.fields.erase("stem");
  question.fields.erase("flatten");
  question.pose.axis = found.body.axis;
  question.pose.up = found.body.up;
  question.pose.contact = found.body.contact;
  question.pose.stem = found.body.stem.radius;
  question.pose.flatten = found.body.flatten;
  question.problem.settings = core::settings_of(found, "problem");
  return question;
}

/// Of a pose that is to be found. The solution's question is in it; where there is none, as it was asked.
Solution solve_open(core::Session& session, const Question& question, const core::RunConfig& open,
                    const core::Along rays, const Control& control) {
  const core::FoundPoses found = core::find_poses(session, open, control);
  core::RunConfig usual = core::in_usual_pose(open);
  for (const core::PoseCandidate& candidate : found.good) {
    const core::RunConfig config = core::posed(open, candidate);
    core::SolvedRun run(session, config, control, rays);
    run.solve(control);
    if (!run.result.outcome.converged()) continue;
    if (question.certify > 0) run.certify(control);
    return solution_of(in_pose(question, config), run);
  }
  usual.body.stem = {};  // it may be what cannot be had
  core::SolvedRun run(session, usual, control, rays);
  run.result.outcome.termination = core::Termination::infeasible;
  run.result.outcome.message = "no pose will do";
  run.result.outcome.x.assign(run.task().formulation.num_variables(), 0.0);
  run.result.infeasibility = found.text();
  return solution_of(question, run);
}

}  // namespace

Solution Session::solve(const Question& question, const Control& control) {
  return state_->asked([&] {
    const core::RunConfig open = core::config_of(question);
    if (core::leaves_open(open))
      return solve_open(state_->session, question, open,
                        question.certify > 0 ? core::Along::own_axis : core::Along::any_axis, control);
    // Certificates know problems in the frame of their rays alone.
    const core::Along rays = question.certify > 0 ? core::Along::own_axis : core::Along::any_axis;
    core::SolvedRun run(state_->session, core::config_of(question), control, rays);
    run.solve(control);
    if (question.certify > 0) run.certify(control);
    return solution_of(question, run);
  });
}

std::string Session::remedies(const Solution& solution, const Control& control) {
  if (solution.end != Solution::End::infeasible) return {};
  return state_->asked([&] {
    const core::RunConfig config = core::in_usual_pose(core::config_of(solution.question));
    const core::Stages stages = state_->session.stages(config, control);
    const std::string poses = core::other_poses(state_->session, config, stages.pose->axis, control);
    if (!stages.problem->impossible().empty()) return poses;
    const std::string help =
        core::what_would_help(config, *stages.body, *stages.problem, *stages.device, control);
    return poses.empty() ? help : help + "; or " + poses;
  });
}

Part Session::part(const Solution& solution, const PartSpec& spec, const Control& control) {
  if (!solution.feasible())
    throw InputError(fmt::format("a part of what is {}: {}; expected a solution that is feasible",
                                 solution.end == Solution::End::infeasible ? "infeasible" : "not solved",
                                 solution.unmet.empty() ? solution.message : solution.unmet.front()));
  core::DesignSpec design;
  design.config = core::config_of(solution.question);
  design.config.certify = 0;
  design.printer_accuracy = spec.accuracy;
  design.tolerance = spec.tolerance;
  design.cut = spec.cut;
  design.peg_radius = spec.pegs;
  design.drain_radius = spec.drain;
  design.lay_flat = spec.lay_flat;
  return state_->asked([&] {
    const core::Design made = core::make_design(state_->session, design, control);
    if (!made.feasible())
      throw InputError(
          fmt::format("a part about an axis that is infeasible along its own rays: {}; expected "
                      "another axis, or more cells",
                      made.run.infeasibility));
    return part_of(made);
  });
}

Map Session::map(const Question& question, int axes, bool centre, const Control& control) {
  core::MapRun run(core::config_of(question));
  run.axes = axes;
  run.through = centre ? core::Through::centre : core::Through::lowest;
  core::MapSpec spec = core::map_spec(run);
  // A question asks for one case: as it says, or as its problem has it.
  if (const auto& cases = core::find_problem(run.problem).map; cases && !cases->setting.empty()) {
    const auto settings = core::settings_of(run, "problem");
    const auto given = settings.find(cases->setting);
    spec.drafts = {given == settings.end() ? cases->usual : given->second};
  }
  const core::OrientationMap found =
      state_->asked([&] { return core::map_orientations(state_->session, spec, control); });
  control.stop_if_asked();
  Map map;
  map.asked = question;
  map.axes = found.axes;
  map.contacts = found.contacts;
  for (const core::MapAnswer& answer : found.answers) {
    map.feasible.push_back(answer.status == core::MapAnswer::feasible);
    map.ok.push_back(answer.verdict.ok);
    map.objective.push_back(answer.objective);
  }
  if (const auto best = found.best()) map.best = best->axis;
  return map;
}

const std::vector<std::string>& Session::made() const { return state_->made; }

Question Map::question(std::size_t i) const {
  Question one = asked;
  forget_direction(one);
  const bool upright = core::find_problem(one.problem.name).upright;
  (upright ? one.pose.up : one.pose.axis) = axes.at(i);
  (upright ? one.pose.axis : one.pose.up) = std::nullopt;
  one.pose.contact = contacts.at(i);
  return one;
}

}  // namespace kreisel
