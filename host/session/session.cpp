#include "session/session.hpp"

#include <array>
#include <numbers>
#include <utility>

#include "error.hpp"
#include "problem/turned.hpp"
#include "session/of_deformed.hpp"
#include "stop.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

bool same_pose(const Body& a, const Body& b) { return a.axis == b.axis && a.contact == b.contact; }

/// Lays the body anew where rays along its axis would run along the cut, and nobody asked for them.
void lay_rays_across_the_cut(Body& body, const Body& made, const Asked& question) {
  const BodySpec& given = question.body;
  if (given.axis || given.up || given.shaped_along_axis()) return;
  const ProblemEntry& asked = find_problem(question.problem);
  if (!asked.rays) return;
  if (const auto axis = asked.rays(problem_settings(question), body))
    reframe(body, made, *axis, given.contact.value_or(lowest_point(made.mesh, *axis)));
}

/// May rays along `laid` serve this problem about another axis? A plane must not run along them: then whole
/// rays are on one side or the other, and their moments jump.
bool serves(const ProblemEntry& asked, const Body& laid, const Body& pose) {
  return !asked.upright || laid.axis.dot(pose.axis) > 1 / std::numbers::sqrt3;
}

/// The body in its own frame, of the pose's densities.
std::shared_ptr<const Body> with_densities_of(const Body& pose, const std::shared_ptr<const Body>& body) {
  const auto densities = [](const Body& of) {
    return std::array{of.density, of.interior_density, of.void_density};
  };
  if (densities(pose) == densities(*body)) return body;
  auto other = std::make_shared<Body>(*body);
  other->density = pose.density;
  other->interior_density = pose.interior_density;
  other->void_density = pose.void_density;
  return other;
}

}  // namespace

Session::Session() = default;
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

Session::Session(std::shared_ptr<const Source> solid, std::shared_ptr<device::Device> device)
    : given_(std::move(solid)), given_device_(std::move(device)) {}

template <class Key, class Value, class Make>
std::shared_ptr<Value> Session::stage(std::string_view name, Kept<Key, Value>& kept, Key key,
                                      const Make& make) {
  return kept.get(std::move(key), [&] {
    std::shared_ptr<Value> value = make();
    made_.push_back(name);
    return value;
  });
}

std::shared_ptr<device::Device> Session::device_of(const Asked& question) {
  if (given_device_) return given_device_;
  return stage("device", device_, {question.device, question.single_precision}, [&] {
    provenance_.reset();
    return std::make_shared<device::Device>(question.device, question.single_precision
                                                                 ? device::Precision::single
                                                                 : device::Precision::automatic);
  });
}

std::shared_ptr<const Source> Session::solid(const Asked& question) {
  if (given_) return given_;
  const BodySpec& given = question.body;
  return stage("mesh", source_, {given.model, given.fineness, given.unit, given.mending},
               [&] { return std::make_shared<const Source>(load_solid(given)); });
}

std::shared_ptr<const Body> Session::body_of(const Asked& question, const BodySpec& spec,
                                             const std::shared_ptr<device::Device>& device) {
  const std::shared_ptr<const Source> source = solid(question);
  std::optional<BodySpec> shaped;
  if (spec.shaped_along_axis()) shaped = spec;
  return stage("body", body_, {source, device, spec.size, shaped}, [&] {
    made_as_ = spec;
    return std::make_shared<const Body>(make_body(spec, *source, *device));
  });
}

std::shared_ptr<const Body> Session::pose_of(const Asked& question, const BodySpec& spec,
                                             const std::shared_ptr<const Body>& body) {
  SettingTexts laid_by;
  if (find_problem(question.problem).rays)
    laid_by = settings_of(question, "problem");
  else if (spec == made_as_)
    return body;
  return stage("pose", pose_, {body, spec, laid_by}, [&] {
    auto pose = std::make_shared<Body>(reposed(*body, spec));
    lay_rays_across_the_cut(*pose, *body, question);
    return std::shared_ptr<const Body>(std::move(pose));
  });
}

RunDomain Session::domain_within(const Asked& question, const Body& pose) {
  RunDomain domain;
  if (kreisel::core::domain_of(question) == "exact") {
    const auto& lines = lines_.get({body_.value(), pose.axis, pose.contact, question.grid}, [&] {
      return std::make_shared<const SolidLines>(solid_lines(pose, question.grid));
    });
    domain.exact = make_exact(pose, *lines, question.wall);
  } else {
    domain.columns = make_columns(pose, question.grid, question.wall);
  }
  return domain;
}

std::shared_ptr<const Session::Laid> Session::domain_of(const Asked& question,
                                                        const std::shared_ptr<const Body>& pose, Along rays) {
  DomainKey key{body_.value(), pose->axis,   pose->contact, kreisel::core::domain_of(question),
                question.grid, question.wall};
  if (key.kind == "exact") key.wall.to_corners = false;  // of voxels
  // What is said in cells, or of the longest side, is another length in another frame.
  const bool in_any_frame = question.wall.unit == Wall::millimetres && !question.grid.cells;
  const ProblemEntry& asked = find_problem(question.problem);
  const bool turns = rays == Along::any_axis && in_any_frame && key.kind == "exact" && !asked.rays &&
                     find_formulation(question.formulation).offers.oracle &&
                     !question.body.shaped_along_axis();
  if (turns && domain_.key()) {
    DomainKey as_laid = key;
    as_laid.axis = domain_.key()->axis;
    as_laid.contact = domain_.key()->contact;
    if (domain_.holds(as_laid) && serves(asked, *domain_.value()->body, *pose)) return domain_.value();
  }
  return stage("domain", domain_, std::move(key), [&] {
    return std::make_shared<const Laid>(
        Laid{std::make_shared<const RunDomain>(domain_within(question, *pose)), pose});
  });
}

std::shared_ptr<const Problem> Session::problem_of(const Asked& question,
                                                   const std::shared_ptr<const Body>& pose,
                                                   const std::shared_ptr<const Body>& rays) {
  return stage("problem", problem_, {pose, rays, question.problem, settings_of(question, "problem")}, [&] {
    std::unique_ptr<Problem> problem = find_problem(question.problem).make(problem_settings(question), *pose);
    if (!same_pose(*pose, *rays)) {
      const Eigen::Matrix3d R = pose->frame.rotation * rays->frame.rotation.transpose();
      problem = std::make_unique<Turned>(std::move(problem), R, pose->frame.to_body(rays->frame.origin));
    }
    return std::shared_ptr<const Problem>(std::move(problem));
  });
}

std::shared_ptr<Formulation> Session::formulation_of(const Asked& question, const Laid& laid,
                                                     const Problem& problem,
                                                     const std::shared_ptr<device::Device>& device) {
  const SettingTexts settings = settings_of(question, "formulation");
  const RunDomain& domain = *laid.domain;
  const Traits traits = domain.exact ? Traits{} : problem.traits();
  return stage("formulation", formulation_,
               {laid.domain, domain.exact ? "quadric" : question.formulation, settings, traits.filling}, [&] {
                 std::shared_ptr<Formulation> made =
                     domain.exact
                         ? make_quadric(domain.rays(), *device)
                         : make_formulation(question.formulation, *domain.columns, traits, settings, *device);
                 made->warm_up();
                 return made;
               });
}

Stages Session::stages(const Asked& question, const Control& control, Along rays) {
  made_.clear();
  const StopScope scope(control.stop);
  // What needs no work is checked first, so that a typing error costs no time.
  const ProblemEntry& asked = find_problem(question.problem);
  if (question.free || question.flatten)
    throw InputError(
        "a pose that is to be found (auto, near or rest); expected a direction here, three numbers x,y,z");
  (void)find_formulation(question.formulation);
  (void)kreisel::core::domain_of(question);
  Stages stages;
  const Stopwatch opening;
  stages.device = device_of(question);
  stages.opening_seconds = opening.seconds();
  control.tell("set-up");
  const std::shared_ptr<const Source> source = solid(question);
  try {
    lay_out(stages, question, asked, control, rays);
  } catch (const InputError&) {
    if (!given_) require_unit_said(question.body, *source);  // in another unit all may be right
    throw;
  }
  return stages;
}

void Session::lay_out(Stages& stages, const Asked& question, const ProblemEntry& asked,
                      const Control& control, Along rays) {
  const BodySpec spec = asked.posed(question.body);
  const std::shared_ptr<const Body> body = body_of(question, spec, stages.device);
  control.stop_if_asked();
  control.tell("set-up: what can be filled");
  const std::shared_ptr<const Body> pose = stages.pose = pose_of(question, spec, body);
  const std::shared_ptr<const Laid> laid = domain_of(question, pose, rays);
  stages.domain = laid->domain;
  control.stop_if_asked();
  stages.body = same_pose(*laid->body, *pose) ? pose : with_densities_of(*pose, laid->body);
  stages.problem = problem_of(question, pose, laid->body);
  stages.mass = hollowed(*stages.body, laid->domain->interior());
  stages.formulation = formulation_of(question, *laid, *stages.problem, stages.device);
  control.stop_if_asked();
}

namespace {

/// The settings that a deformation goes by. The quadric's own solver and formulation have none of it.
SettingTexts what_deforms(const RunConfig& question) {
  SettingTexts all = question.settings;
  const bool by_quadrics = find_formulation(question.formulation).offers.oracle;
  if (by_quadrics)
    std::erase_if(all, [](const auto& setting) {
      return !setting.first.starts_with("problem.") && !setting.first.starts_with("deform.");
    });
  else
    all.insert({{"formulation", question.formulation}, {"solver", question.solver}});
  return all;
}

}  // namespace

std::shared_ptr<Session::OfDeformed> Session::deformed(const RunConfig& question, const Stages& stages,
                                                       const Control& control) {
  return stage("deformed", deformed_,
               {stages.pose, stages.domain, question.problem, what_deforms(question), question.deform,
                question.grid.resolution},
               [&] {
                 auto made = std::make_shared<OfDeformed>();
                 made->body = kreisel::core::deformed(stages, question, control);
                 if (made->body.solid) made->session.emplace(made->body.solid, stages.device);
                 return made;
               });
}

const Provenance& Session::provenance() {
  if (!provenance_) provenance_ = make_provenance(given_device_ ? *given_device_ : *device_.value());
  return *provenance_;
}

}  // namespace kreisel::core
