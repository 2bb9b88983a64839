#include "solve/explain.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "parse.hpp"

namespace kreisel::core {
namespace {

/// Some of a problem's constraints, with the margin as the goal.
class Relaxed final : public Problem {
 public:
  Relaxed(const Problem& problem, const std::vector<Eigen::Index>& rows) : problem_(problem) {
    const LinearConstraints& all = problem.constraints();
    constraints_.matrix = all.matrix(rows, Eigen::all);
    constraints_.lower = all.lower(rows);
    constraints_.upper = all.upper(rows);
    for (const Eigen::Index r : rows) constraints_.names.push_back(all.names[static_cast<std::size_t>(r)]);
  }
  [[nodiscard]] std::string_view name() const override { return problem_.name(); }
  [[nodiscard]] Convexity convexity() const override { return Convexity::linear; }
  [[nodiscard]] Goal goal() const override { return Goal::margin; }
  [[nodiscard]] double value(const Moments& s) const override { return problem_.value(s); }
  [[nodiscard]] Moments gradient(const Moments& s) const override { return problem_.gradient(s); }
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override { return problem_.hessian(s); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override {
    return problem_.verify(s, length_mm);
  }

 private:
  const Problem& problem_;
  LinearConstraints constraints_;
};

/// What each of `rows` is missed by, at the moments where the worst is missed least.
std::vector<double> least_misses(const SolverEntry& solver, const Task& task, const SolverOptions& options,
                                 const std::vector<Eigen::Index>& rows) {
  const Relaxed relaxed(task.problem, rows);
  const Outcome best = solver.solve({relaxed, task.formulation, task.mass, task.device, task.stop}, options);
  const LinearConstraints& c = relaxed.constraints();
  const Eigen::VectorXd value = c.matrix * best.moments;
  std::vector<double> misses;
  for (Eigen::Index r = 0; r < value.size(); ++r)
    misses.push_back(std::max({0.0, c.lower[r] - value[r], value[r] - c.upper[r]}));
  return misses;
}

struct Miss {
  std::string name;
  double amount;  ///< as printed: what reads the same is the same, and stays in the problem's order
};

double printed(double amount) { return parse<double>(fmt::format("{:.3g}", amount)).value_or(amount); }

}  // namespace

std::string explain_infeasible(const SolverEntry& solver, const Task& task, const SolverOptions& options) {
  const LinearConstraints& c = task.problem.constraints();
  std::vector<Eigen::Index> all(static_cast<std::size_t>(c.matrix.rows()));
  for (std::size_t r = 0; r < all.size(); ++r) all[r] = static_cast<Eigen::Index>(r);
  const Nonlinear* more = task.problem.nonlinear();
  const auto only_nonlinear = [&] {
    return fmt::format("{} cannot be met, though the linear constraints alone can", more->asked_by());
  };
  if (all.empty()) return more ? only_nonlinear() : "there are no constraints: the solver gave up";
  const std::vector<double> together = least_misses(solver, task, options, all);
  const double worst = std::ranges::max(together);
  // Solvers meet constraints to 1e-9; a miss of a millionth is none that anybody could measure.
  constexpr double none = 1e-6;
  if (worst <= none && more && more->lower().size() > 0 && more->variables() == 0) return only_nonlinear();
  if (worst <= none) return "the constraints alone can be met: the solver stopped at a local infeasibility";

  std::vector<Miss> alone, shared;
  for (const Eigen::Index r : all) {
    const auto i = static_cast<std::size_t>(r);
    if (together[i] <= none) continue;
    shared.push_back({c.names[i], printed(together[i])});
    const double miss = least_misses(solver, task, options, {r}).front();
    if (miss > none) alone.push_back({c.names[i], printed(miss)});
  }
  std::ranges::stable_sort(alone, std::ranges::greater(), &Miss::amount);
  std::ranges::stable_sort(shared, std::ranges::greater(), &Miss::amount);
  std::vector<std::string> words;
  for (const Miss& m : alone) words.push_back(fmt::format("{} is out of reach by {:.3g}", m.name, m.amount));
  if (!alone.empty()) return fmt::format("{} (body units)", fmt::join(words, "; "));
  std::vector<double> amounts;
  for (const Miss& m : shared) {
    words.push_back(m.name);
    amounts.push_back(m.amount);
  }
  return fmt::format("{} cannot be met together: the best compromise misses them by {:.3g} (body units)",
                     fmt::join(words, ", "), fmt::join(amounts, ", "));
}

}  // namespace kreisel::core
