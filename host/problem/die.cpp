#include "problem/die.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "error.hpp"
#include "problem/ray_direction.hpp"

namespace kreisel::core {
namespace {

bool is_inside(const ConvexHull& hull, const Vec3& p) {
  for (std::size_t f = 0; f < hull.facets.size(); ++f)
    if (hull.normal(f).dot(p - hull.corner(f, 0)) >= 0) return false;
  return true;
}

/// Unfairness of a centre of mass: the sum of squares of what the shares differ by; that faces are lost or
/// gained counts as one of them never coming up.
double unfairness(const ConvexHull& hull, const Vec3& centre, std::size_t faces) {
  if (!is_inside(hull, centre)) return 2;
  std::vector<double> shares = face_shares(hull, centre);
  shares.resize(std::max(shares.size(), faces), 0.0);
  const double mean = 1 / static_cast<double>(faces);
  double sum = 0;
  for (const double share : shares) sum += (share - mean) * (share - mean);
  return sum;
}

ConvexHull hull_of_body(const Body& body) {
  ConvexHull hull = body.hull.of(body.mesh.vertices);
  for (Vec3& v : hull.vertices) v = body.frame.to_body(v);
  return hull;
}

/// From the start to the fairest; where that is the start itself, some way that is not taken.
Vec3 way(const Vec3& start, const Vec3& fairest) {
  const Vec3 along = fairest - start;
  return along.norm() > 1e-9 ? along : Vec3::UnitZ();
}

}  // namespace

std::vector<double> face_shares(const ConvexHull& hull, const Vec3& centre) {
  std::vector<double> shares;
  for (const RestingPose& pose : resting_poses(hull, centre))
    if (pose.stable()) shares.push_back(pose.probability);
  return shares;
}

Vec3 fairest_centre(const ConvexHull& hull, const Vec3& start) {
  const std::size_t faces = face_shares(hull, start).size();
  struct Corner {
    Vec3 at;
    double loss;
  };
  const auto corner = [&](const Vec3& at) { return Corner{at, unfairness(hull, at, faces)}; };
  const double step = 0.02 * bounding_box(hull.vertices).extent().maxCoeff();
  std::array<Corner, 4> simplex = {corner(start), corner(start + step * Vec3::UnitX()),
                                   corner(start + step * Vec3::UnitY()),
                                   corner(start + step * Vec3::UnitZ())};
  for (int i = 0; i < 300; ++i) {
    std::ranges::stable_sort(simplex, {}, &Corner::loss);
    Corner& worst = simplex[3];
    if ((worst.at - simplex[0].at).norm() < 1e-7 * step) break;
    const Vec3 middle = (simplex[0].at + simplex[1].at + simplex[2].at) / 3;
    const auto along = [&](double t) { return corner(middle + t * (worst.at - middle)); };
    const Corner reflected = along(-1);
    if (reflected.loss < simplex[0].loss) {
      const Corner farther = along(-2);
      worst = farther.loss < reflected.loss ? farther : reflected;
    } else if (reflected.loss < simplex[2].loss) {
      worst = reflected;
    } else if (const Corner nearer = along(reflected.loss < worst.loss ? -0.5 : 0.5);
               nearer.loss < std::min(reflected.loss, worst.loss)) {
      worst = nearer;
    } else {
      for (std::size_t k = 1; k < 4; ++k) simplex[k] = corner((simplex[0].at + simplex[k].at) / 2);
    }
  }
  return std::ranges::min_element(simplex, {}, &Corner::loss)->at;
}

Die::Die(ConvexHull hull, const Moments& solid)
    : hull_(std::move(hull)),
      start_(centre_of_mass(solid)),
      fairest_(fairest_centre(hull_, start_)),
      line_(start_, way(start_, fairest_)) {
  const Vec3 along = way(start_, fairest_);
  numerator_.segment<3>(SX) = along / along.squaredNorm();
  numerator_[S1] = -along.dot(start_) / along.squaredNorm();
}

Moments Die::gradient(const Moments& s) const { return -(numerator_ + value(s) * Moments::Unit(S1)) / s[S1]; }

Matrix10 Die::hessian(const Moments& s) const {
  const Moments g = gradient(s), mass = Moments::Unit(S1);
  return -(g * mass.transpose() + mass * g.transpose()) / s[S1];
}

std::optional<Ratio> Die::ratio() const { return Ratio{-numerator_.transpose(), Moments::Unit(S1)}; }

std::unique_ptr<Problem> Die::next(const Moments& s) const {
  // At the very end of what can be reached there is one interior, and no solver settles on it.
  constexpr double within = 0.99;
  const double t = (fairest_ - start_).norm() > 1e-9 ? std::clamp(-within * value(s), 0.0, 1.0) : 0.0;
  return std::make_unique<Balance>(start_ + t * (fairest_ - start_), std::nullopt);
}

Verdict Die::verify(const Moments& s, double length_mm) const {
  const Vec3 c = centre_of_mass(s);
  const std::vector<double> shares = face_shares(hull_, c), solid = face_shares(hull_, start_);
  const auto [least, most] = std::ranges::minmax(shares);
  const auto [solid_least, solid_most] = std::ranges::minmax(solid);
  const double off = (c - fairest_).norm();
  Verdict verdict;
  verdict.ok = off <= 1e-3 || unfairness(hull_, c, solid.size()) < unfairness(hull_, start_, solid.size());
  verdict.values = {{"faces", static_cast<double>(shares.size())},
                    {"least_share", least},
                    {"most_share", most},
                    {"to_fairest_mm", off * length_mm},
                    {"mass_share", s[S1]},
                    {"objective", value(s)}};
  verdict.text = fmt::format(
      "{}: each of {} faces comes up in {:.2f} to {:.2f} % of all throws (of the solid {:.2f} to {:.2f} %); "
      "centre of "
      "mass {:.3f} mm ({:.1e} L) from where they are most alike",
      verdict.ok ? "a die as fair as this interior can be" : "is no fairer than the solid", shares.size(),
      100 * least, 100 * most, 100 * solid_least, 100 * solid_most, off * length_mm, off);
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
