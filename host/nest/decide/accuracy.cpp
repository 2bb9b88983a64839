#include "nest/decide/accuracy.hpp"

#include <algorithm>

#include "nest/decide/bisection.hpp"
#include "nest/decide/envelope.hpp"
#include "nest/decide/exact.hpp"
#include "nest/decide/hybrid.hpp"
#include "nest/decide/peel.hpp"
#include "nest/decide/random.hpp"
#include "statistics.hpp"

namespace kreisel::core::nest {
namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}

  Placement operator()(const Nesting& nesting) {
    Placement placement;
    placement.pose.rotation = rotation();
    // A's box lies about the origin.
    const Vec3 extent = nesting.outer_box().extent();
    placement.pose.centroid = 0.5 * extent.cwiseProduct(point());
    placement.cut = Cut::through(placement.pose.centroid, rotation().col(0));
    for (Vec3* removal : {&placement.cut.plus, &placement.cut.minus})
      *removal = (*removal + point()).normalized();
    return placement;
  }

 private:
  /// In the cube of side 1 about the origin.
  Vec3 point() {
    const double x = next(), y = next(), z = next();
    return Vec3(x, y, z) - Vec3::Constant(0.5);
  }
  Eigen::Matrix3d rotation() {
    const double u = next(), v = next(), w = next();
    return uniform_rotation(u, v, w).toRotationMatrix();
  }

  double next() { return uniform(seed_, drawn_++); }

  std::uint64_t seed_, drawn_ = 0;
};

SampledError summary(int resolution, const std::vector<double>& errors, int missed, double tolerance) {
  SampledError out;
  out.resolution = resolution;
  out.missed = missed;
  if (errors.empty()) return out;
  for (const double e : errors) {
    out.optimistic += e > tolerance;
    out.pessimistic += e < -tolerance;
  }
  out.median = quantile(errors, 0.5);
  out.most_of = quantile(errors, 0.95);
  out.largest = std::ranges::max(errors);
  return out;
}

}  // namespace

Accuracy compare(device::Device& device, const Nesting& nesting, int placements,
                 const std::vector<int>& resolutions, std::uint64_t seed, const std::stop_token& stop) {
  Accuracy out;
  Draw draw(seed);
  Hybrid hybrid(nesting);
  Exact exact(nesting);
  Peel peel(device, nesting, 128);
  Envelope envelope(device, nesting, 128);
  std::vector<std::unique_ptr<ScaleSearch>> sampled;
  for (const int resolution : resolutions)
    sampled.push_back(make_search("envelope", device, nesting, resolution));
  std::vector<std::vector<double>> errors(resolutions.size());
  std::vector<int> missed(resolutions.size());
  SearchLimits limits;
  limits.upper = nesting.largest_scale();
  for (int k = 0; k < placements && !stop.stop_requested(); ++k) {
    Placement placement = draw(nesting);
    ++out.placements;
    const double scale = hybrid.search(placement, limits).scale;
    if (k % 10 == 0) {
      placement.pose.scale = scale > 0 ? scale : 0.2;
      const FaultMap peeled = peel.map(placement), drawn = envelope.map(placement);
      out.pixels += long(drawn.size());
      for (std::size_t i = 0; i < drawn.size(); ++i)
        out.peel_disagrees += (peeled[i] == 0) != (drawn[i] == 0);
    }
    if (!(scale > 0)) continue;
    ++out.nested;
    const auto valid_at = [&](double s) {
      placement.pose.scale = s;
      return exact.check(placement).valid();
    };
    out.exact_agrees += valid_at(scale) && !valid_at(scale + limits.tolerance);
    for (std::size_t r = 0; r < resolutions.size(); ++r) {
      const double found = sampled[r]->search(placement, limits).scale;
      if (found > 0)
        errors[r].push_back(found - scale);
      else
        ++missed[r];
    }
  }
  for (std::size_t r = 0; r < resolutions.size(); ++r)
    out.errors.push_back(summary(resolutions[r], errors[r], missed[r], limits.tolerance));
  return out;
}

}  // namespace kreisel::core::nest
