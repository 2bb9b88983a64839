#include "problem/problem.hpp"

#include <utility>

#include "error.hpp"

namespace kreisel {

void add_problem(ProblemSpec spec) {
  if (!spec.make) throw InputError("problem '" + spec.name + "' without a way to make it; expected `make`");
  core::ProblemEntry entry;
  entry.name = std::move(spec.name);
  entry.summary = std::move(spec.summary);
  entry.upright = spec.upright;
  entry.centred = spec.centred;
  entry.poses = spec.poses;
  const auto posed = [](const core::Body& body) {
    return PosedBody{body.mesh,         body.frame.rotation, body.frame.origin,
                     body.frame.length, body.solid,          body.density};
  };
  entry.settings = core::SettingTable::open();
  if (spec.choices)
    entry.choices = [choices = std::move(spec.choices), posed](const core::Settings& settings,
                                                               const core::Body& body) {
      const auto each = choices(core::settings_as<core::SettingTexts>(settings), posed(body));
      return std::vector<core::Settings>(each.begin(), each.end());
    };
  entry.make = [make = std::move(spec.make), name = entry.name, posed](const core::Settings& settings,
                                                                       const core::Body& body) {
    std::unique_ptr<Problem> problem = make(core::settings_as<core::SettingTexts>(settings), posed(body));
    if (!problem) throw InputError("problem '" + name + "' was not made; expected an object");
    const LinearConstraints& c = problem->constraints();
    const Eigen::Index rows = c.matrix.rows();
    if (c.lower.size() != rows || c.upper.size() != rows || static_cast<Eigen::Index>(c.names.size()) != rows)
      throw InputError("problem '" + name + "': " + std::to_string(rows) + " rows with " +
                       std::to_string(c.lower.size()) + " lower and " + std::to_string(c.upper.size()) +
                       " upper bounds and " + std::to_string(c.names.size()) +
                       " names; expected one of each a row");
    return problem;
  };
  core::problems().add(std::move(entry));
}

}  // namespace kreisel
