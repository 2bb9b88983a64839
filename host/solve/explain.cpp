#include "solve/explain.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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

struct Miss {
  std::string name;
  double
      amount;  ///< body units, as printed: what reads the same is the same, and stays in the problem's order
  std::string text;  ///< with its unit
};

double printed(double amount) { return parse<double>(fmt::format("{:.3g}", amount)).value_or(amount); }

/// Three digits of what a row is missed by, and in what.
std::string amount_text(double amount, double mass, const Eigen::Ref<const Eigen::RowVectorXd>& row,
                        const std::optional<BodyUnits>& units) {
  const auto text = [](double value, const char* unit) { return fmt::format("{:.3g}{}", value, unit); };
  if (!units) return text(amount, "");
  const bool first = !row.segment<3>(SX).isZero(0), second = !row.tail<6>().isZero(0);
  if (first && second) return text(amount, " (body units)");
  if (second) return text(amount * units->grams * units->millimetres * units->millimetres, " g mm^2");
  if (first) return text(amount / std::max(mass, 1e-300) * units->millimetres, " mm");
  return text(amount * units->grams, " g");
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
    const auto add = [&](std::vector<Miss>& to, double amount, double mass) {
      if (amount > none)
        to.push_back({c.names[i], printed(amount), amount_text(amount, mass, c.matrix.row(r), units)});
    };
    if (together.amounts[i] <= none) continue;
    add(shared, together.amounts[i], together.mass);
    const LeastMisses by_itself = least_misses(solver, task, options, {r});
    add(alone, by_itself.amounts.front(), by_itself.mass);
  }
  std::ranges::stable_sort(alone, std::ranges::greater(), &Miss::amount);
  std::ranges::stable_sort(shared, std::ranges::greater(), &Miss::amount);
  std::vector<std::string> words;
  const char* in = units ? "" : " (body units)";
  for (const Miss& m : alone) words.push_back(fmt::format("{} is out of reach by {}", m.name, m.text));
  if (!alone.empty()) return fmt::format("{}{}", fmt::join(words, "; "), in);
  std::vector<std::string> amounts;
  for (const Miss& m : shared) {
    words.push_back(m.name);
    amounts.push_back(m.text);
  }
  return fmt::format("{} cannot be met together: the best compromise misses them by {}{}",
                     fmt::join(words, ", "), fmt::join(amounts, ", "), in);
}

}  // namespace kreisel::core
