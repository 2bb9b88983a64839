#include "solve/explain.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "parse.hpp"
#include "solve/with_rows.hpp"

namespace kreisel::core {
namespace {

/// Some of a problem's constraints.
LinearConstraints some_of(const LinearConstraints& all, const std::vector<Eigen::Index>& rows) {
  LinearConstraints some{all.matrix(rows, Eigen::all), all.lower(rows), all.upper(rows), {}};
  for (const Eigen::Index r : rows) some.names.push_back(all.names[static_cast<std::size_t>(r)]);
  return some;
}

/// How rows are missed at the moments where the worst is missed least.
struct LeastMisses {
  std::vector<double> amounts;  ///< body units
  double mass;                  ///< there
};

LeastMisses least_misses(const SolverEntry& solver, const Task& task, const SolverOptions& options,
                         const std::vector<Eigen::Index>& rows) {
  const WithRows relaxed(task.problem, some_of(task.problem.constraints(), rows), Goal::margin);
  const Outcome best = solver.solve({relaxed, task.formulation, task.mass, task.device, task.stop}, options);
  const LinearConstraints& c = relaxed.constraints();
  const Eigen::VectorXd value = c.matrix * best.moments;
  LeastMisses misses{{}, best.moments[S1]};
  for (Eigen::Index r = 0; r < value.size(); ++r)
    misses.amounts.push_back(std::max({0.0, c.lower[r] - value[r], value[r] - c.upper[r]}));
  return misses;
}

/// What stays of one constraint, or of several that a problem calls alike: perpendicular ones.
struct Miss {
  std::string name;
  double amount;  ///< body units
  double shown;   ///< in `unit`
  std::string unit;
};

/// A row's miss in what a maker has it in; " (body units)" where no unit fits.
Miss miss_of(const std::string& name, double amount, double mass,
             const Eigen::Ref<const Eigen::RowVectorXd>& row, const std::optional<BodyUnits>& units) {
  if (!units) return {name, amount, amount, ""};
  const bool first = !row.segment<3>(SX).isZero(0), second = !row.tail<6>().isZero(0);
  if (first && second) return {name, amount, amount, " (body units)"};
  if (second)
    return {name, amount, amount * units->grams * units->millimetres * units->millimetres, " g mm^2"};
  if (first) return {name, amount, amount / std::max(mass, 1e-300) * units->millimetres, " mm"};
  return {name, amount, amount * units->grams, " g"};
}

void add(std::vector<Miss>& misses, const Miss& miss) {
  const auto alike = std::ranges::find(misses, miss.name, &Miss::name);
  if (alike == misses.end()) return misses.push_back(miss);
  alike->amount = std::hypot(alike->amount, miss.amount);
  alike->shown = std::hypot(alike->shown, miss.shown);
}

/// As printed, for sorting: what reads the same is the same, and stays in the problem's order.
double printed(const Miss& miss) {
  return parse<double>(fmt::format("{:.3g}", miss.amount)).value_or(miss.amount);
}

/// The worst first, each a sentence with three digits.
std::string text_of(std::vector<Miss> misses) {
  std::ranges::stable_sort(misses, std::ranges::greater(), printed);
  std::vector<std::string> sentences;
  for (const Miss& miss : misses) {
    const std::string amount = fmt::format("{:.3g}{}", miss.shown, miss.unit);
    std::string sentence = miss.name;
    if (const std::size_t place = sentence.find("{}"); place != std::string::npos)
      sentence.replace(place, 2, amount);
    else
      sentence += " is missed by " + amount;
    sentences.push_back(std::move(sentence));
  }
  return fmt::format("{}", fmt::join(sentences, "; "));
}

}  // namespace

std::string explain_infeasible(const SolverEntry& solver, const Task& task, const SolverOptions& options,
                               const std::optional<BodyUnits>& units) {
  const LinearConstraints& c = task.problem.constraints();
  std::vector<Eigen::Index> all(static_cast<std::size_t>(c.matrix.rows()));
  for (std::size_t r = 0; r < all.size(); ++r) all[r] = static_cast<Eigen::Index>(r);
  const Nonlinear* more = task.problem.nonlinear();
  const auto only_nonlinear = [&] {
    return fmt::format("{} cannot be met, though the linear constraints alone can", more->asked_by());
  };
  if (all.empty()) return more ? only_nonlinear() : "there are no constraints: the solver gave up";
  const LeastMisses together = least_misses(solver, task, options, all);
  const double worst = std::ranges::max(together.amounts);
  // Solvers meet constraints to 1e-9; a miss of a millionth is none that anybody could measure.
  constexpr double none = 1e-6;
  if (worst <= none && more && more->lower().size() > 0 && more->variables() == 0) return only_nonlinear();
  if (worst <= none) return "the constraints alone can be met: the solver stopped at a local infeasibility";

  std::vector<Miss> alone, shared;
  for (const Eigen::Index r : all) {
    const auto i = static_cast<std::size_t>(r);
    const auto note = [&](std::vector<Miss>& to, double amount, double mass) {
      if (amount > none) add(to, miss_of(c.names[i], amount, mass, c.matrix.row(r), units));
    };
    if (together.amounts[i] <= none) continue;
    note(shared, together.amounts[i], together.mass);
    const LeastMisses by_itself = least_misses(solver, task, options, {r});
    note(alone, by_itself.amounts.front(), by_itself.mass);
  }
  const char* in = units ? "" : " (body units)";
  if (!alone.empty()) return text_of(alone) + in;
  return fmt::format("not all that is asked can be met together; in the best compromise {}{}",
                     text_of(shared), in);
}

}  // namespace kreisel::core
