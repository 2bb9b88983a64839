#include "problem/fairness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace kreisel::core {
namespace {

/// What comes up less often than this, beside what a fair die's faces do, is no face: an edge that is blunt,
/// a fold of a scan.
constexpr double least_share = 0.1;

/// A face that comes up less often than this counts as if it did as often: a wait has an end.
constexpr double rarest = 1e-4;

constexpr double sphere = 4 * std::numbers::pi;

}  // namespace

Fairness::Fairness(ConvexHull hull, const Vec3& start)
    : hull_(std::move(hull)), grounds_(hull_), start_(start) {
  const Resting resting = grounds_.at(start);
  for (std::size_t g = 0; g < resting.poses.size(); ++g)
    if (resting.poses[g].stable()) faces_.push_back(g);
  const double fair = 1 / static_cast<double>(faces_.size());
  std::erase_if(faces_, [&](std::size_t g) { return resting.poses[g].probability < least_share * fair; });
}

bool Fairness::is_inside(const Vec3& p) const {
  for (std::size_t f = 0; f < hull_.facets.size(); ++f)
    if (hull_.normal(f).dot(p - hull_.corner(f, 0)) >= 0) return false;
  return true;
}

double Fairness::loss(const Vec3& centre) const {
  const auto n = static_cast<double>(faces_.size());
  if (!is_inside(centre)) return 1 / (n * rarest);
  const Resting resting = grounds_.at(centre);
  double waits = 0;
  for (const std::size_t g : faces_) {
    const RestingPose& pose = resting.poses[g];
    waits += 1 / (pose.stable() ? std::max(pose.probability, rarest) : rarest);
  }
  return waits / (n * n) - 1;
}

Vec3 Fairness::gradient(const Vec3& centre) const {
  const std::vector<std::uint32_t> ends = grounds_.at(centre).ends;
  struct Share {
    double value = 0;
    Vec3 slope = Vec3::Zero();
  };
  std::vector<Share> shares(grounds_.count());
  for (std::size_t f = 0; f < ends.size(); ++f) {
    const Vec3 &a = hull_.corner(f, 0), &b = hull_.corner(f, 1), &c = hull_.corner(f, 2);
    shares[ends[f]].value += solid_angle(centre, a, b, c) / sphere;
    shares[ends[f]].slope += solid_angle_gradient(centre, a, b, c) / sphere;
  }
  Vec3 sum = Vec3::Zero();
  for (const std::size_t g : faces_)
    if (const double p = shares[g].value; p > rarest) sum -= shares[g].slope / (p * p);
  return sum / static_cast<double>(faces_.size() * faces_.size());
}

std::vector<double> Fairness::shares(const Vec3& centre) const {
  const Resting resting = grounds_.at(centre);
  std::vector<double> shares;
  for (const std::size_t g : faces_)
    shares.push_back(resting.poses[g].stable() ? resting.poses[g].probability : 0.0);
  return shares;
}

Vec3 Fairness::fairest() const {
  struct Corner {
    Vec3 at;
    double loss;
  };
  const auto corner = [&](const Vec3& at) { return Corner{at, loss(at)}; };
  const double step = 0.02 * bounding_box(hull_.vertices).extent().maxCoeff();
  std::array<Corner, 4> simplex = {corner(start_), corner(start_ + step * Vec3::UnitX()),
                                   corner(start_ + step * Vec3::UnitY()),
                                   corner(start_ + step * Vec3::UnitZ())};
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

}  // namespace kreisel::core
