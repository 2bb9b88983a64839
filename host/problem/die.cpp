#include "problem/die.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "problem/balance.hpp"
#include "problem/ray_direction.hpp"

namespace kreisel::core {
namespace {

ConvexHull hull_of_body(const Body& body) {
  ConvexHull hull = body.hull.of(body.mesh.vertices);
  for (Vec3& v : hull.vertices) v = body.frame.to_body(v);
  return hull;
}

/// Nearer to the fairest the solid is there: a tenth of what a verdict takes for nothing, body lengths.
constexpr double no_way = 1e-4;

/// From the start to the fairest; where that is the start itself, some way that is not taken.
Vec3 way(const Vec3& start, const Vec3& fairest) {
  const Vec3 along = fairest - start;
  return along.isZero(0) ? Vec3::UnitZ() : along;
}

DieGoal goal_of(ConvexHull hull, const Vec3& start) {
  auto fairness = std::make_shared<const Fairness>(std::move(hull), start);
  const Vec3 fairest = fairness->fairest();
  return {std::move(fairness), start, (fairest - start).norm() < no_way ? start : fairest};
}

/// What is known on the way to a fair die.
struct Search : DieGoal {
  explicit Search(const DieGoal& goal) : DieGoal(goal) {}

  Vec3 best = start;  ///< that can be reached
  double loss = fairness->loss(start);
  double radius = 0.1;  ///< of the next step, body lengths

  /// Goes from the best to the fairest of some points up to `end`, which can be reached. Whether it moved.
  bool advance(const Vec3& end) {
    constexpr int shares = 64;
    const Vec3 from = best;
    const double before = loss;
    for (int i = 1; i <= shares; ++i) {
      const Vec3 at = from + static_cast<double>(i) / shares * (end - from);
      if (const double here = fairness->loss(at); here < loss) loss = here, best = at;
    }
    return loss < before;
  }
};

/// A step of the search: the farthest interior in one direction that meets a few rows.
class Step final : public Reach {
 public:
  using Onward = std::unique_ptr<Problem> (*)(Search, const Vec3& reached);

  Step(const Search& search, const Vec3& along, LinearConstraints rows, Onward onward)
      : Reach(search.best, along), search_(search), rows_(std::move(rows)), onward_(onward) {}

  [[nodiscard]] const LinearConstraints& constraints() const override { return rows_; }
  [[nodiscard]] std::unique_ptr<Problem> next(const Moments& s) const override {
    return onward_(search_, centre_of_mass(s));
  }
  /// Nothing is asked of it alone.
  [[nodiscard]] Verdict verify(const Moments&, double) const override { return {}; }

 private:
  Search search_;
  LinearConstraints rows_;
  Onward onward_;
};

/// |c - middle| <= radius along each axis.
LinearConstraints box_around(const Vec3& middle, double radius) {
  LinearConstraints rows;
  rows.matrix.setZero(6, 10);
  rows.lower = Eigen::VectorXd::Constant(6, -std::numeric_limits<double>::infinity());
  rows.upper = Eigen::VectorXd::Zero(6);
  for (int k = 0; k < 3; ++k)
    for (const int side : {0, 1}) {
      const Eigen::Index row = 2 * k + side;
      const double sign = side ? -1 : 1;
      rows.matrix(row, SX + k) = sign;
      rows.matrix(row, S1) = -sign * middle[k] - radius;
      rows.names.emplace_back("the centre of mass stays {} outside the box that is searched");
    }
  return rows;
}

/// As much material as there can be at the best.
std::unique_ptr<Problem> settle(const Search& search) {
  // At the very end of what can be reached there is one interior, and no solver settles on it.
  constexpr double within = 0.99;
  const bool all_the_way = search.best == search.fairest;
  return std::make_unique<Balance>(search.start + (all_the_way ? 1 : within) * (search.best - search.start),
                                   std::nullopt);
}

std::unique_ptr<Problem> descend(Search search);

std::unique_ptr<Problem> after_descent(Search search, const Vec3& reached) {
  search.radius *= search.advance(reached) ? 1.5 : 0.25;
  return descend(std::move(search));
}

std::unique_ptr<Problem> descend(Search search) {
  constexpr double least = 1e-3;  // what a verdict takes for nothing
  const Vec3 downhill = -search.fairness->gradient(search.best);
  if (search.radius < least || !(downhill.norm() > 1e-6)) return settle(search);
  return std::make_unique<Step>(search, downhill, box_around(search.best, search.radius), after_descent);
}

std::unique_ptr<Problem> after_the_way(Search search, const Vec3& reached) {
  const Vec3 along = search.fairest - search.start;
  const double t = along.dot(reached - search.start) / along.squaredNorm();
  if (t >= 1) {
    search.best = search.fairest;
    return settle(search);
  }
  search.advance(search.start + t * along);
  return descend(std::move(search));
}

}  // namespace

Reach::Reach(const Vec3& from, const Vec3& along) {
  numerator_.segment<3>(SX) = -along / along.squaredNorm();
  numerator_[S1] = along.dot(from) / along.squaredNorm();
}

Moments Reach::gradient(const Moments& s) const {
  return (numerator_ - value(s) * Moments::Unit(S1)) / s[S1];
}

Matrix10 Reach::hessian(const Moments& s) const {
  const Moments g = gradient(s), mass = Moments::Unit(S1);
  return -(g * mass.transpose() + mass * g.transpose()) / s[S1];
}

std::optional<Ratio> Reach::ratio() const { return Ratio{numerator_.transpose(), Moments::Unit(S1)}; }

Die::Die(ConvexHull hull, const Moments& solid) : Die(goal_of(std::move(hull), centre_of_mass(solid))) {}

Die::Die(DieGoal goal) : Reach(goal.start, way(goal.start, goal.fairest)), goal_(std::move(goal)) {}

std::unique_ptr<Problem> Die::next(const Moments&) const {
  const Search search(goal_);
  const Vec3 along = goal_.fairest - goal_.start;
  if (along.isZero(0)) return settle(search);
  return std::make_unique<Step>(search, along, Balance(goal_.start, along).constraints(), after_the_way);
}

Verdict Die::verify(const Moments& s, double length_mm) const {
  const Vec3 c = centre_of_mass(s);
  const std::vector<double> shares = goal_.fairness->shares(c), solid = goal_.fairness->shares(goal_.start);
  const auto [least, most] = std::ranges::minmax(shares);
  const auto [solid_least, solid_most] = std::ranges::minmax(solid);
  const double off = (c - goal_.fairest).norm(), loss = goal_.fairness->loss(c);
  const bool fairest = off <= 1e-3, fairer = loss < goal_.fairness->loss(goal_.start);
  Verdict verdict;
  verdict.ok = fairest || fairer;
  verdict.values = {{"faces", static_cast<double>(shares.size())},
                    {"least_share", least},
                    {"most_share", most},
                    {"excess_wait", loss},
                    {"to_fairest_mm", off * length_mm},
                    {"mass_share", s[S1]},
                    {"objective", value(s)}};
  verdict.text = fmt::format(
      "{}: each of {} faces comes up in {:.2f} to {:.2f} % of all throws (of the solid {:.2f} to {:.2f} %); "
      "a "
      "face is waited for {:.2f} % longer than with a fair die; centre of mass {:.3f} mm ({:.1e} L) from "
      "where "
      "the faces are most alike",
      fairest  ? "a die as fair as its shape allows"
      : fairer ? "a fairer die than the solid"
               : "is no fairer than the solid",
      shares.size(), 100 * least, 100 * most, 100 * solid_least, 100 * solid_most, 100 * loss,
      off * length_mm, off);
  return verdict;
}

std::unique_ptr<Problem> make_die(const Settings&, const Body& body) {
  return std::make_unique<Die>(hull_of_body(body), body.solid);
}

std::optional<Vec3> rays_of_die(const Settings&, const Body& body) {
  const Vec3 at = body.frame.to_model(Die(hull_of_body(body), body.solid).fairest());
  return rays_of_balance(LineSettings{at, {}}, body);
}

}  // namespace kreisel::core
