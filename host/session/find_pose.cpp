#include "session/find_pose.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "error.hpp"
#include "geometry/rotation.hpp"
#include "physics/units.hpp"
#include "session/pose_directions.hpp"
#include "session/sweep.hpp"

namespace kreisel::core {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr int coarse = 48;        // cells along the longest side
constexpr double apart = 4;       // degrees between candidates that are handed out
constexpr std::size_t most = 40;  // of them

bool is_auto(const RunConfig& config) {
  return std::ranges::any_of(config.settings, [](const auto& setting) {
    return setting.first.starts_with("problem.") && setting.second == "auto";
  });
}

/// The question as the search asks it: on few cells, of the solid without what is made along an axis.
RunConfig on_few_cells(const RunConfig& config) {
  RunConfig few = in_usual_pose(config);
  few.grid = {};
  few.grid.resolution = coarse;
  few.formulation = "quadric";
  few.solver.clear();
  few.domain.clear();
  few.certify = 0;
  few.body.stem = {};
  few.body.axle = {};
  std::erase_if(few.settings, [](const auto& setting) { return !setting.first.starts_with("problem."); });
  return few;
}

/// One pose and what it is worth: less is better. Those that can be had come before those that cannot, and
/// those by how far off they are.
struct Tried {
  PoseCandidate candidate;
  bool ok = false;
  double worth = infinite;
};

class Search {
 public:
  Search(const RunConfig& config, const Stages& stages, const RunConfig& few, const Control& control)
      : config_(config),
        asked_(find_problem(config.problem)),
        stages_(stages),
        control_(control),
        sweep_(stages, few, control) {
    const Settings settings = problem_settings(config);
    choices_ = asked_.choices ? asked_.choices(settings, *stages.body) : std::vector{settings};
  }

  [[nodiscard]] FoundPoses run() {
    const std::vector<Through> ways = ways_through();
    for (const Through through : ways) {
      look_through(through);
      if (found_.good.empty()) continue;
      if (through != ways.back()) {
        found_.onward = config_;
        found_.onward->free->through = ways.back();
      }
      break;
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool has_axis() const { return !asked_.upright && !asked_.centred; }
  [[nodiscard]] std::vector<Through> ways_through() const {
    if (!has_axis() || !config_.free) return {Through::lowest};
    if (config_.free && config_.free->through) return {*config_.free->through};
    return {Through::lowest, Through::centre};
  }

  void look_through(Through through) {
    PoseDirections directions = directions_of(config_, asked_, *stages_.pose, choices_.size());
    PosesTried count;
    count.what = !has_axis()                  ? (asked_.upright ? "poses" : "axes through the centre of mass")
                 : through == Through::lowest ? "axes through the lowest point"
                                              : "axes through the centre of mass, on a stem";
    count.spacing = directions.spacing;
    std::vector<Tried> all;
    for (const Vec3& direction : directions.list) try_pose(direction, choices_, through, count, all);
    if (directions.spacing > 0) refine(directions, through, count, all);
    count.unjoined = hand_out(std::move(all), through);
    found_.tried.push_back(std::move(count));
  }

  void try_pose(const Vec3& direction, const std::vector<Settings>& choices, Through through,
                PosesTried& count, std::vector<Tried>& all) {
    const Vec3 contact = !config_.free    ? stages_.pose->contact
                         : asked_.centred ? stages_.body->frame.to_model(centre_of_mass(stages_.body->solid))
                                          : contact_of(*stages_.body, direction, through);
    sweep_.turn(direction, contact);
    bool good = false, possible = false, decided = true, never = true;
    for (const Settings& settings : choices) {
      control_.stop_if_asked();
      const auto answer = sweep_.answer(settings);
      if (!answer) throw Interrupted();
      Tried tried;
      tried.candidate.direction = direction.normalized();
      tried.candidate.through = through;
      tried.candidate.settings = settings;
      tried.candidate.flatten = config_.body.flatten;
      tried.candidate.loss = answer->loss;
      if (has_axis() && config_.free) tried.candidate.contact = contact;
      tried.ok = answer->verdict.ok;
      if (answer->status == MapAnswer::feasible)
        tried.worth = answer->loss;
      else if (std::isfinite(answer->miss))
        tried.worth = 1e3 + answer->miss;
      good |= tried.ok;
      possible |= answer->status == MapAnswer::feasible;
      decided &= answer->status != MapAnswer::undecided;
      never &= answer->impossible;
      all.push_back(std::move(tried));
    }
    ++count.tried;
    count.good += good;
    if (!possible) ++(never ? count.impossible : decided ? count.infeasible : count.undecided);
    if (count.tried % 50 == 0) control_.tell(fmt::format("{} {}", count.tried, count.what));
  }

  /// From the best few, in steps that halve: rings of six around what is best so far.
  void refine(const PoseDirections& directions, Through through, PosesTried& count, std::vector<Tried>& all) {
    const bool choosing = choices_.size() > 1;  // few directions and many settings: each step costs more
    const std::size_t starts = choosing ? 3 : 5;
    const double finest = directions.spacing / (choosing ? 8 : 16);
    std::vector<Tried> begin = spread(all, 2 * directions.spacing, starts);
    for (const Tried& start : begin) {
      Tried best = start;
      for (double step = directions.spacing / 2; step > finest; step /= 2) {
        const std::size_t first = all.size();
        const Eigen::Matrix3d axes = axes_along(best.candidate.direction);
        for (int k = 0; k < 6; ++k) {
          const double turn = std::numbers::pi / 3 * k, angle = step * std::numbers::pi / 180;
          const Vec3 across = std::cos(turn) * axes.row(0) + std::sin(turn) * axes.row(1);
          const Vec3 direction = std::cos(angle) * best.candidate.direction + std::sin(angle) * across;
          if (directions.holds(direction))
            try_pose(direction, {best.candidate.settings}, through, count, all);
        }
        for (std::size_t i = first; i < all.size(); ++i)
          if (all[i].worth < best.worth) best = all[i];
      }
    }
  }

  /// The best, none near another. @param degrees_apart  between their directions
  [[nodiscard]] static std::vector<Tried> spread(std::vector<Tried> all, double degrees_apart,
                                                 std::size_t count) {
    std::ranges::stable_sort(all, {}, &Tried::worth);
    std::vector<Tried> kept;
    const double cosine = std::cos(degrees_apart * std::numbers::pi / 180);
    for (Tried& tried : all) {
      if (kept.size() == count || !std::isfinite(tried.worth)) break;
      if (std::ranges::none_of(kept, [&](const Tried& other) {
            return other.candidate.direction.dot(tried.candidate.direction) > cosine;
          }))
        kept.push_back(std::move(tried));
    }
    return kept;
  }

  /// @return  how many take no stem
  std::size_t hand_out(std::vector<Tried> all, Through through) {
    std::size_t unjoined = 0;
    // A way of lying that is asked for by its number is tried as it is.
    const bool as_it_is = config_.free && config_.free->rest;
    if (!as_it_is) std::erase_if(all, [](const Tried& tried) { return !tried.ok; });
    const bool stemmed = through == Through::centre || config_.body.stem.wanted();
    for (Tried& tried : spread(std::move(all), apart, most)) {
      if (has_axis() && config_.free && stemmed && !find_stem(tried.candidate))
        ++unjoined;
      else
        found_.good.push_back(std::move(tried.candidate));
    }
    return unjoined;
  }

  /// The thickest peg that can be joined to the body there; the one asked for, where one is. False: none.
  bool find_stem(PoseCandidate& candidate) const {
    const Frame axis{axis_to_z(candidate.direction), *candidate.contact, 1};
    const TriangleMesh laid = to_body(axis, stages_.pose->mesh);
    const auto joins = [&](const StemSpec& spec) {
      try {
        (void)with_stem(laid, stem_of(spec).value());
        return true;
      } catch (const InputError&) {
        return false;
      }
    };
    if (config_.body.stem.wanted()) return joins(config_.body.stem);
    // Slender, and yet of several of a printer's lines.
    for (const double share : {0.03, 0.02, 0.013}) {
      candidate.stem = share * bounding_box(stages_.pose->mesh).extent().maxCoeff();
      if (joins({.radius = candidate.stem})) return true;
    }
    return false;
  }

  const RunConfig& config_;
  const ProblemEntry& asked_;
  const Stages& stages_;
  const Control& control_;
  Sweep sweep_;
  std::vector<Settings> choices_;
  FoundPoses found_;
};

}  // namespace

std::string PosesTried::text() const {
  std::string words = fmt::format("{} {} were tried", tried, what);
  if (spacing > 0) words += fmt::format(", {:.0f} degrees apart and finer near the best", spacing);
  const std::size_t fail = tried - good - infeasible - undecided - impossible;
  words += fmt::format(": {} will do", good == 0 ? "none" : std::to_string(good));
  if (infeasible > 0)
    words += fmt::format(
        "; for {} no interior meets what is asked, each with a quadric that separates the two", infeasible);
  if (impossible > 0) words += fmt::format("; in {} no interior whatever can, as without a base", impossible);
  if (fail > 0) words += fmt::format("; {} can be balanced, but the best interior does not do it", fail);
  if (unjoined > 0)
    words += fmt::format(
        "; at {} of them no stem can be joined to the body (--through lowest, or a thinner --stem)",
        unjoined);
  if (undecided > 0) words += fmt::format("; {} are undecided", undecided);
  return words;
}

std::string FoundPoses::text() const {
  std::vector<std::string> words;
  for (const PosesTried& kind : tried) words.push_back(kind.text());
  return fmt::format("{}", fmt::join(words, ". "));
}

bool leaves_open(const RunConfig& config) { return config.free || config.flatten || is_auto(config); }

RunConfig in_usual_pose(RunConfig config) {
  config.free.reset();
  config.flatten = false;
  std::erase_if(config.settings, [](const auto& setting) {
    return setting.first.starts_with("problem.") && setting.second == "auto";
  });
  return config;
}

RunConfig posed(const RunConfig& config, const PoseCandidate& candidate) {
  const ProblemEntry& asked = find_problem(config.problem);
  RunConfig question = in_usual_pose(config);
  // What was given stays as it was written; what was left open is erased by now.
  for (const auto& [name, value] : asked.settings.changed(candidate.settings))
    question.settings.try_emplace("problem." + name, value);
  question.body.flatten = candidate.flatten;
  if (!config.free) return question;
  (asked.upright ? question.body.up : question.body.axis) = candidate.direction;
  (asked.upright ? question.body.axis : question.body.up).reset();
  question.body.contact = candidate.contact;
  if (candidate.stem) question.body.stem.radius = candidate.stem;
  return question;
}

namespace {

FoundPoses search(Session& session, const RunConfig& config, const Control& control) {
  RunConfig few = on_few_cells(config);
  if (config.free) few.body.axis = few.body.up = few.body.contact = std::nullopt;
  const Stages stages = session.stages(few, control);
  return Search(config, stages, few, control).run();
}

/// In the pose that was asked for, with as little cut off at the bottom as will do, to a sixteenth of it.
FoundPoses flattened_least(Session& session, RunConfig config, const Control& control) {
  config.body.flatten.reset();
  const std::shared_ptr<const Body> body = session.stages(on_few_cells(config), control).pose;
  const double height = bounding_box(body->local).extent()[2] * body->frame.length;
  const auto at = [&](double share) {
    control.stop_if_asked();
    config.body.flatten = share * height;
    return search(session, config, control);
  };
  PosesTried count{.what = "cuts at the bottom"};
  double too_little = 0;
  for (double share = 0.002; share < 0.3; share *= 2) {
    FoundPoses found = at(share);
    ++count.tried;
    if (found.good.empty()) {
      ++count.impossible;
      too_little = share;
      continue;
    }
    double enough = share;
    while (enough - too_little > share / 16) {
      const double middle = (too_little + enough) / 2;
      FoundPoses there = at(middle);
      ++count.tried;
      if (there.good.empty()) {
        ++count.impossible;
        too_little = middle;
      } else {
        ++count.good;
        enough = middle, found = std::move(there);
      }
    }
    ++count.good;
    found.tried = {count};
    return found;
  }
  return {{}, {count}};
}

}  // namespace

FoundPoses find_poses(Session& session, const RunConfig& config, const Control& control) {
  const ProblemEntry& asked = find_problem(config.problem);
  if (config.free && asked.poses == Poses::none)
    throw InputError(fmt::format(
        "problem {} with a pose that is to be found; expected a direction, for {} is asked in one pose",
        asked.name, asked.name));
  control.tell("look for a pose");
  RunConfig open = config;
  if (open.free || !open.flatten) {
    open.body.flatten.reset();
    FoundPoses found = search(session, open, control);
    if (!found.good.empty() || !config.flatten) return found;
    open.free.reset();
    FoundPoses cut = flattened_least(session, open, control);
    found.good = std::move(cut.good);
    std::ranges::move(cut.tried, std::back_inserter(found.tried));
    return found;
  }
  return flattened_least(session, open, control);
}

}  // namespace kreisel::core
