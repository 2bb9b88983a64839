#include "library/config_of.hpp"

#include <fmt/format.h>

#include "error.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {

RunConfig config_of(const Question& question) {
  RunConfig config;
  config.body.axis = question.pose.axis;
  config.body.up = question.pose.up;
  config.body.contact = question.pose.contact;
  config.body.size = question.pose.size;
  config.body.density = question.densities.shell;
  config.body.interior_density = question.densities.interior;
  config.body.void_density = question.densities.filling;
  config.body.axle = {question.pose.axle, question.pose.slot, question.pose.axle_depth};
  set_field(config, "problem", question.problem.name);
  set_field(config, "formulation", question.formulation.name);
  if (!question.solver.name.empty()) set_field(config, "solver", question.solver.name);
  if (!question.domain.kind.empty()) set_field(config, "domain", question.domain.kind);
  config.body.stem = {question.pose.stem, question.pose.tip, question.pose.tip_height};
  config.body.flatten = question.pose.flatten;
  if (!question.pose.find.empty())
    set_field(config, find_problem(config.problem).upright ? "up" : "axis", question.pose.find);
  const auto& cells = question.domain.cells;
  set_field(config, "resolution",
            cells[1] == 0 && cells[2] == 0 ? fmt::format("{}", cells[0])
                                           : fmt::format("{}x{}x{}", cells[0], cells[1], cells[2]));
  set_field(config, "wall",
            question.domain.wall.empty() ? fmt::format("{}", question.domain.wall_mm) : question.domain.wall);
  if (question.certify != 0) set_field(config, "certify", fmt::format("{}", question.certify));
  const std::string solver = solver_of(config);
  for (const auto& [group, choice] : {std::pair<std::string, const Choice&>{"problem", question.problem},
                                      {"formulation", question.formulation},
                                      {solver, question.solver}})
    for (const auto& [name, value] : choice.settings) {
      // Settings of every solver stand beside those of the one in use: solver.start, ipopt.max_iter.
      const bool whole = name.find('.') != std::string::npos;
      set_field(config, whole ? name : group + "." + name, value);
    }
  require_settings(config);
  return config;
}

}  // namespace kreisel::core
