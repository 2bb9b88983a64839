// problem.hpp - what is asked of the ten moments: minimise f(s) subject to lower <= C s <= upper.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "body/body.hpp"
#include "kreisel/verdict.hpp"

namespace kreisel::core {

/// Linear constraints on the total moments, body units.
struct LinearConstraints {
  Eigen::Matrix<double, Eigen::Dynamic, 10> matrix;
  Eigen::VectorXd lower, upper;
  std::vector<std::string> names;
};

using kreisel::Verdict;

/// What is known of f over the convex set of attainable moments; decides which certificates apply.
enum class Convexity { linear, fractional, pseudoconvex, spin, top };

/// How the optimum fills a ray along z: `segment`, some inner part of it; `either_end`, from one of its ends,
/// not known beforehand which; `from_below`, from its lower end, which leaves one variable a ray.
enum class Filling { segment, either_end, from_below };

/// What a solver minimises: f, or the margin, the smallest t with lower - t <= C s <= upper + t. The margin
/// is negative as far as inequalities can be met with something to spare.
enum class Goal { value, margin };

/// f = the largest of numerators . s / denominator . s, where denominator . s > 0 for all attainable moments.
struct Ratio {
  Eigen::Matrix<double, Eigen::Dynamic, 10> numerators;  ///< one a row
  Moments denominator;
  bool constrained = true;  ///< whether constraints() are the problem's, or only those of a step (next())
};

/// What shortens or shapes a formulation's variables.
struct Traits {
  Filling filling = Filling::segment;
};

/// Variables a that a problem has beside the moments, and equations between both: minimise value(s, a)
/// subject to residuals(s, a) = 0 and the problem's linear constraints on s. Derivatives are in (s, a), the
/// ten moments first.
class Auxiliary {
 public:
  virtual ~Auxiliary() = default;

  [[nodiscard]] virtual int variables() const = 0;
  [[nodiscard]] virtual int equations() const = 0;
  /// Where to start from, given the moments of the start.
  [[nodiscard]] virtual Eigen::VectorXd start(const Moments& s) const = 0;
  [[nodiscard]] virtual double value(const Moments& s, const Eigen::VectorXd& a) const = 0;
  [[nodiscard]] virtual Eigen::VectorXd gradient(const Moments& s, const Eigen::VectorXd& a) const = 0;
  [[nodiscard]] virtual Eigen::MatrixXd hessian(const Moments& s, const Eigen::VectorXd& a) const = 0;
  [[nodiscard]] virtual Eigen::VectorXd residuals(const Moments& s, const Eigen::VectorXd& a) const = 0;
  /// One equation a row.
  [[nodiscard]] virtual Eigen::MatrixXd jacobian(const Moments& s, const Eigen::VectorXd& a) const = 0;
  /// Hessian of multipliers . residuals.
  [[nodiscard]] virtual Eigen::MatrixXd curvature(const Moments& s, const Eigen::VectorXd& a,
                                                  const Eigen::VectorXd& multipliers) const = 0;
};

/// A mass-property problem. All moments are totals in body frame and units (body.hpp).
class Problem {
 public:
  virtual ~Problem() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;
  [[nodiscard]] virtual Convexity convexity() const = 0;
  [[nodiscard]] virtual Traits traits() const { return {}; }
  [[nodiscard]] virtual Goal goal() const { return Goal::value; }

  [[nodiscard]] virtual double value(const Moments& s) const = 0;
  [[nodiscard]] virtual Moments gradient(const Moments& s) const = 0;
  [[nodiscard]] virtual Matrix10 hessian(const Moments& s) const = 0;
  [[nodiscard]] virtual const LinearConstraints& constraints() const = 0;

  /// The form with variables of its own, where that is what was asked for, else nullptr; value(s) is then the
  /// least over them. Only solvers that say so take it (SolverEntry).
  [[nodiscard]] virtual const Auxiliary* auxiliary() const { return nullptr; }

  /// The objective of a fractional problem; nothing for others.
  [[nodiscard]] virtual std::optional<Ratio> ratio() const { return std::nullopt; }

  /// A problem that is a search over a parameter, solved as a sequence: the next one, given the moments that
  /// solve this one; nullptr when they are the answer.
  [[nodiscard]] virtual std::unique_ptr<Problem> next(const Moments&) const { return nullptr; }

  /// What could be asked of this body with this shell, in a sentence; empty when there is nothing to say.
  [[nodiscard]] virtual std::string scope(const MassModel&) const { return {}; }

  /// Judges a finished solid by exact criteria. @param length_mm  one body length in millimetres
  [[nodiscard]] virtual Verdict verify(const Moments& s, double length_mm) const = 0;
};

/// Largest violation of the problem's constraints, body units.
[[nodiscard]] double violation(const Problem& problem, const Moments& s);

/// Settings of a problem, from `--set problem.NAME=VALUE`.
using ProblemSettings = std::map<std::string, std::string>;

/// One line of `bench list` and the way to make the problem.
struct ProblemEntry {
  std::string_view name, summary;
  /// @param body  what is to spin, stand or float; not kept
  std::unique_ptr<Problem> (*make)(const ProblemSettings& settings, const Body& body);
  /// The settings with which a solid is judged as it is; nothing when the problem asks for more than a solid
  /// has.
  std::optional<ProblemSettings> for_solid;
  bool upright = false;                         ///< goes by the body's up direction, not by its spin axis
  std::vector<std::string_view> settings = {};  ///< names that `make` knows
  ProblemSettings weights = {};                 ///< those that say what f is, with their defaults
  bool centred = false;  ///< the body frame's origin is its centre of mass where no point is given

  /// A body as this problem poses it.
  [[nodiscard]] BodySpec posed(BodySpec spec) const {
    spec.stands_upright = upright;
    spec.centred = centred;
    return spec;
  }
};

[[nodiscard]] const std::vector<ProblemEntry>& problems();

/// @throws InputError  unknown problem (names those there are)
[[nodiscard]] const ProblemEntry& find_problem(std::string_view name);

/// @throws InputError  unknown problem, unknown or unfit setting, or a body the problem makes no sense for
[[nodiscard]] std::unique_ptr<Problem> make_problem(std::string_view name, const ProblemSettings& settings,
                                                    const Body& body);

}  // namespace kreisel::core
