// problem.hpp - what is asked of the ten moments: minimise f(s) subject to lower <= C s <= upper, and to
// nonlinear rows where a problem has any. Derive from Problem and add_problem() it: every formulation, every
// solver that takes it, sessions and parts then do so by its name.
//
// All moments are totals of the whole solid, in the body frame and its units: z along the axis (or up),
// origin at the contact, lengths in V^(1/3), masses in those of the solid body.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kreisel/export.hpp"
#include "kreisel/mesh.hpp"
#include "kreisel/moments.hpp"
#include "kreisel/verdict.hpp"

namespace kreisel {

/// Linear constraints on the total moments, body units.
struct LinearConstraints {
  Eigen::Matrix<double, Eigen::Dynamic, 10> matrix;
  Eigen::VectorXd lower, upper;
  std::vector<std::string> names;  ///< what is said of a miss, "the mass stays {} too large"; or mere names
};

/// Water that a body lies in, body frame and units.
struct Water {
  double surface;  ///< z
  double density;  ///< in those of the body's shell
};

/// What is known of f over the convex set of attainable moments; decides which certificates apply. `unknown`:
/// a solve ends at a local minimum, and nothing bounds it.
enum class Convexity { linear, fractional, pseudoconvex, spin, top, unknown };

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

/// What `auto` may choose of a pose: nothing, for the question is about one; `any` direction of the axis (or
/// of up); or those in which the body comes to `rest` on the ground, on a facet of its convex hull.
enum class Poses { none, any, rest };

/// What shortens or shapes a formulation's variables.
struct Traits {
  Filling filling = Filling::segment;
};

/// Total moments from the designed part alone: s = fixed + contrast * s_domain, in body units.
/// The one place where shell, interior and void come together.
///
/// Designed is always where the *heavier* of interior and void goes, so that the contrast is positive and
/// "solid", to whatever finds a filling, is what weighs more. With heavy voids the roles are swapped: what a
/// formulation leaves solid is then the voids' filling. [docs/materials.md]
struct MassModel {
  Moments fixed = Moments::Zero();  ///< the shell, and the whole interior at the lighter of its densities
  double contrast = 1;              ///< > 0: the heavier less the lighter, in densities of the shell
  /// Of the whole domain at unit density; zero where nobody asks for the heaviest part.
  Moments interior = Moments::Zero();

  [[nodiscard]] Moments total(const Moments& domain) const { return fixed + contrast * domain; }
};

/// What a problem has beside linear rows: nonlinear ones, lower <= rows(s, a) <= upper, and variables a of
/// its own, perhaps none, in which it is minimised as well: minimise value(s, a). Derivatives are in (s, a),
/// the ten moments first.
class Nonlinear {
 public:
  virtual ~Nonlinear() = default;

  /// How it came to be asked for, for a message: "problem.form = angle".
  [[nodiscard]] virtual std::string asked_by() const = 0;
  [[nodiscard]] virtual int variables() const { return 0; }
  /// Where a starts, given the moments of the start. (variables(),)
  [[nodiscard]] virtual Eigen::VectorXd start(const Moments&) const { return {}; }
  [[nodiscard]] virtual double value(const Moments& s, const Eigen::VectorXd& a) const = 0;
  [[nodiscard]] virtual Eigen::VectorXd gradient(const Moments& s, const Eigen::VectorXd& a) const = 0;
  [[nodiscard]] virtual Eigen::MatrixXd hessian(const Moments& s, const Eigen::VectorXd& a) const = 0;
  /// Bounds of the rows, infinite where there is none; as many as there are rows.
  [[nodiscard]] virtual const Eigen::VectorXd& lower() const = 0;
  [[nodiscard]] virtual const Eigen::VectorXd& upper() const = 0;
  [[nodiscard]] virtual Eigen::VectorXd rows(const Moments& s, const Eigen::VectorXd& a) const = 0;
  /// (rows, 10 + variables())
  [[nodiscard]] virtual Eigen::MatrixXd jacobian(const Moments& s, const Eigen::VectorXd& a) const = 0;
  /// Hessian of multipliers . rows.
  [[nodiscard]] virtual Eigen::MatrixXd curvature(const Moments& s, const Eigen::VectorXd& a,
                                                  const Eigen::VectorXd& multipliers) const = 0;
};

/// A mass-property problem.
class KREISEL_API Problem {
 public:
  virtual ~Problem() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;
  [[nodiscard]] virtual Convexity convexity() const { return Convexity::unknown; }
  [[nodiscard]] virtual Traits traits() const { return {}; }
  [[nodiscard]] virtual Goal goal() const { return Goal::value; }

  [[nodiscard]] virtual double value(const Moments& s) const = 0;
  [[nodiscard]] virtual Moments gradient(const Moments& s) const = 0;
  [[nodiscard]] virtual Matrix10 hessian(const Moments& s) const = 0;
  [[nodiscard]] virtual const LinearConstraints& constraints() const = 0;

  /// The form with nonlinear rows or variables of its own, where it has any, else nullptr. With variables,
  /// value(s) is the least over them. Only solvers that say so take it (`bench list`). Not beside
  /// Goal::margin.
  [[nodiscard]] virtual const Nonlinear* nonlinear() const { return nullptr; }

  /// The objective of a fractional problem; nothing for others.
  [[nodiscard]] virtual std::optional<Ratio> ratio() const { return std::nullopt; }

  /// A problem that is a search over a parameter, solved as a sequence: the next one, given the moments that
  /// solve this one; nullptr when they are the answer.
  [[nodiscard]] virtual std::unique_ptr<Problem> next(const Moments&) const { return nullptr; }

  /// What could be asked of this body with this shell, in a sentence; empty when there is nothing to say.
  [[nodiscard]] virtual std::string scope(const MassModel&) const { return {}; }

  /// Rows that, where they hold beside constraints(), make what verify() asks beyond those hold as well;
  /// tight near `s`. None where it asks no more. What shapes a body goes by them, no solver does.
  [[nodiscard]] virtual LinearConstraints also_asked(const Moments& /*s*/) const { return {}; }
  /// The point of the body frame that the question is about: where the body's shape changes it goes with the
  /// material there. Default the origin.
  [[nodiscard]] virtual Vec3 anchor() const { return Vec3::Zero(); }

  /// The height, body frame, up to which the shape is part of the question, as the base is that a body stands
  /// on: where the body's shape changes it stays as it is there. Default: there is none.
  [[nodiscard]] virtual std::optional<double> fixed_below() const { return std::nullopt; }
  /// The water that bounds go by: as the shape changes, those of constraints() grow by density times rows .
  /// the moments of what of the body comes to lie below its surface. Default: there is none.
  [[nodiscard]] virtual std::optional<Water> water() const { return std::nullopt; }

  /// Why no interior whatever can do it, in a sentence; empty: that depends on the interior. Then nothing is
  /// solved.
  [[nodiscard]] virtual std::string impossible() const { return {}; }

  /// Of finished solids in two poses of one body, which do it, the one with less does it better.
  [[nodiscard]] virtual double pose_loss(const Moments& s) const { return value(s); }

  /// Judges a finished solid by exact criteria. @param length_mm  one body length in millimetres
  [[nodiscard]] virtual Verdict verify(const Moments& s, double length_mm) const = 0;
  /// verify(), and what becomes of the solid when it is left to itself, which takes longer to find out: for
  /// what is shown, not for what is searched.
  [[nodiscard]] virtual Verdict verify_at_rest(const Moments& s, double length_mm) const {
    return verify(s, length_mm);
  }
};

/// What a problem may know of the body that it is asked of.
struct PosedBody {
  const Mesh& mesh;          ///< model coordinates, mm
  Eigen::Matrix3d rotation;  ///< x_body = rotation (x - origin) / length_mm
  Vec3 origin;
  double length_mm;  ///< V^(1/3)
  Moments solid;     ///< of all of it, body frame and units
  double density;    ///< of the shell, g/cm^3
};

/// A problem of one's own.
struct ProblemSpec {
  std::string name;  ///< none that there is
  std::string summary = {};
  /// Makes it of settings as `--set problem.NAME=VALUE` gives them. The body is not kept.
  /// @throws InputError  an unknown or unfit setting, a body that it makes no sense for
  std::function<std::unique_ptr<Problem>(const std::map<std::string, std::string>& settings,
                                         const PosedBody& body)>
      make;
  bool upright = false;       ///< goes by the body's up direction, not by its spin axis
  bool centred = false;       ///< the body frame's origin is its centre of mass where no point is given
  Poses poses = Poses::none;  ///< what `auto` may choose
  /// The settings, one after the other, that `auto` in one of them stands for; nothing: `make` takes it as it
  /// is. @throws InputError
  std::function<std::vector<std::map<std::string, std::string>>(
      const std::map<std::string, std::string>& settings, const PosedBody& body)>
      choices = {};
};

/// Makes a problem known by its name, in this process. Before the first session, by one thread.
/// @throws InputError  a name that is empty or taken, nothing to make it by
KREISEL_API void add_problem(ProblemSpec spec);

}  // namespace kreisel
