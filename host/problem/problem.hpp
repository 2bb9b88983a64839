// problem.hpp - what is asked of the ten moments: minimise f(s) subject to lower <= C s <= upper.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "body/moments.hpp"

namespace kreisel {

/// Linear constraints on the total moments, body units.
struct LinearConstraints {
  Eigen::Matrix<double, Eigen::Dynamic, 10> matrix;
  Eigen::VectorXd lower, upper;
  std::vector<std::string> names;
};

/// What is known of f over the convex set of attainable moments; decides which certificates apply.
enum class Convexity { linear, fractional, pseudoconvex, spin, top };

/// What shortens or shapes a formulation's variables.
struct Traits {
  bool fills_from_below = false;  ///< the optimum fills every ray from its lower end: one variable a ray
};

/// Does the finished part do what was asked?
struct Verdict {
  bool ok = false;
  std::string text;                      ///< one sentence
  std::map<std::string, double> values;  ///< the numbers behind it; NaN where one does not exist
};

/// A mass-property problem. All moments are totals in body frame and units (body.hpp).
class Problem {
 public:
  virtual ~Problem() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;
  [[nodiscard]] virtual Convexity convexity() const = 0;
  [[nodiscard]] virtual Traits traits() const { return {}; }

  [[nodiscard]] virtual double value(const Moments& s) const = 0;
  [[nodiscard]] virtual Moments gradient(const Moments& s) const = 0;
  [[nodiscard]] virtual Matrix10 hessian(const Moments& s) const = 0;
  [[nodiscard]] virtual const LinearConstraints& constraints() const = 0;

  /// Judges a finished solid by exact criteria. @param length_mm  one body length in millimetres
  [[nodiscard]] virtual Verdict verify(const Moments& s, double length_mm) const = 0;
};

/// Largest violation of the problem's constraints, body units.
[[nodiscard]] double violation(const Problem& problem, const Moments& s);

/// Settings of a problem, from `--set problem.NAME=VALUE`.
using ProblemSettings = std::map<std::string, double>;

/// One line of `bench list` and the way to make the problem.
struct ProblemEntry {
  std::string_view name, summary;
  std::unique_ptr<Problem> (*make)(const ProblemSettings& settings);
};

[[nodiscard]] const std::vector<ProblemEntry>& problems();

/// @throws InputError  unknown problem (names those there are), unknown or unfit setting
[[nodiscard]] std::unique_ptr<Problem> make_problem(std::string_view name, const ProblemSettings& settings);

}  // namespace kreisel
