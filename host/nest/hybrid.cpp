#include "nest/hybrid.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "nest/exact.hpp"
#include "nest/way_out.hpp"
#include "parallel.hpp"

namespace kreisel::nest {
namespace {

constexpr std::size_t most_witnesses = 48;

/// Points of a mesh far from each other, beginning with that farthest from the origin.
std::vector<Vec3> spread_points(const TriangleMesh& mesh, std::size_t count) {
  std::vector<double> distance;
  for (const Vec3& v : mesh.vertices) distance.push_back(v.squaredNorm());
  std::vector<Vec3> points;
  while (points.size() < std::min(count, mesh.vertices.size())) {
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (*farthest <= 0) break;
    const bool first = points.empty();
    points.push_back(mesh.vertices[std::size_t(farthest - distance.begin())]);
    for (std::size_t i = 0; i < distance.size(); ++i) {
      const double d = (mesh.vertices[i] - points.back()).squaredNorm();
      distance[i] = first ? d : std::min(distance[i], d);
    }
  }
  return points;
}

}  // namespace

/// One placement of the two trees.
class Hybrid::Descent {
 public:
  Descent(const Hybrid& hybrid, const Placement& placement)
      : hybrid_(&hybrid),
        placement_(&placement),
        way_(hybrid.rays_, placement),
        scale_(placement.pose.scale),
        frames_{HalfFrame(placement.cut, 0), HalfFrame(placement.cut, 1)} {}

  /// Whether B nests at its own scale.
  Verdict check() {
    for (const Vec3& b : hybrid_->witnesses_)
      if (way_.gap(b, scale_)) return fault(Fault::swept, way_.at(b, scale_));
    for (half_ = 0; half_ < 2; ++half_) {
      std::optional<Vec3> met;
      const bool free = pass([&](const SweptTriangle& swept, const Vec3& x, std::uint32_t) {
        met = frames_[half_].out_of(swept.top(x));
        return false;
      });
      if (!free) return {Fault::swept, half_, *met};
    }
    const auto out = shell_outside();
    return out ? fault(Fault::outside, way_.at(*out, scale_)) : Verdict{};
  }

  /// The largest scale of a nesting, or 0; never above the limits.
  FoundScale search(const SearchLimits& limits, std::vector<Vec3>& deciding) {
    step_ = limits.tolerance / 8;
    enough_ = std::max(limits.abort_below, step_);
    scale_ = limits.upper;
    int rounds = 0;
    for (const Vec3& b : hybrid_->witnesses_) lower(b, deciding);
    for (double before = -1; before != scale_ && scale_ > enough_;) {
      before = scale_;
      ++rounds;
      for (half_ = 0; half_ < 2 && scale_ > enough_; ++half_)
        pass([&](const SweptTriangle&, const Vec3& x, std::uint32_t t) { return pass_by(x, t, deciding); });
      while (scale_ > enough_) {
        const auto out = shell_outside();
        if (!out) break;
        const double now = scale_;
        lower(*out, deciding);
        if (scale_ == now) scale_ -= step_;  // rays that differ by round-off
      }
    }
    if (scale_ > enough_) return {scale_, false, rounds};
    return {0, limits.abort_below > step_, rounds};
  }

 private:
  using Node = SphereTree::Node;
  struct Pair {
    std::uint32_t a, b;
    Vec3 at_a, at_b;  ///< of A's sphere in the half's frame; of B's before it is scaled and moved
  };

  [[nodiscard]] Verdict fault(Fault fault, const Vec3& point) const {
    return {fault, placement_->cut.beyond(0, point) >= 0 ? 0 : 1, point};
  }

  void lower(const Vec3& b, std::vector<Vec3>& deciding) {
    const double to = way_.largest_scale(b, scale_, enough_, step_);
    if (to < scale_) deciding.push_back(b);
    scale_ = to;
  }

  [[nodiscard]] std::optional<Vec3> shell_outside() const {
    for (const std::uint32_t vertex : hybrid_->shells_) {
      const Vec3& b = hybrid_->nesting_->inner().vertices[vertex];
      if (is_out(b)) return b;
    }
    return std::nullopt;
  }
  [[nodiscard]] bool is_out(const Vec3& b) const {
    const Vec3 p = way_.at(b, scale_);
    const auto ahead = hybrid_->rays_.first(p, placement_->cut.plus, 0, 4);
    return !ahead || !ahead->out;
  }

  /// T's corners in the half's frame.
  [[nodiscard]] SweptTriangle swept(std::uint32_t t) const {
    const TriangleMesh& mesh = hybrid_->nesting_->inner();
    const auto corner = [&](int k) -> Vec3 {
      return scale_ * (turn_ * mesh.vertices[mesh.triangles[t][std::size_t(k)]]) + shift_;
    };
    return {frames_[half_], corner(0), corner(1), corner(2)};
  }

  [[nodiscard]] bool clear(const Pair& p, const Node& a, const Node& b) const {
    const double radius = scale_ * b.radius, reach = a.radius + radius;
    const Vec3 at_b = scale_ * p.at_b + shift_;
    if (frames_[half_].beyond(p.at_a) < -a.radius || frames_[half_].beyond(at_b) < -radius) return true;
    Vec3 apart = p.at_a - at_b;
    apart.z() = std::max(apart.z(), 0.0);  // A below B is in its way
    return apart.squaredNorm() > reach * reach * (1 + 1e-12) + 1e-24;
  }

  /// Goes through the pairs of triangles that meet; `met` says whether to go on. @return whether it did to
  /// the end
  template <class Met>
  bool pass(Met&& met) {
    const HalfFrame& frame = frames_[half_];
    turn_ = frame.axes * placement_->pose.rotation;
    shift_ = frame.into(placement_->pose.centroid);
    const auto &nodes_a = hybrid_->outer_.nodes(), &nodes_b = hybrid_->inner_.nodes();
    stack_.assign(1, {0, 0, frame.into(nodes_a[0].centre), turn_ * nodes_b[0].centre});
    while (!stack_.empty()) {
      const Pair p = stack_.back();
      stack_.pop_back();
      const Node &a = nodes_a[p.a], &b = nodes_b[p.b];
      ++visited_;
      if (clear(p, a, b)) continue;
      if (a.count && b.count) {
        if (!leaves(a, b, met)) return false;
      } else if (b.count || (!a.count && a.radius > scale_ * b.radius)) {
        for (std::uint32_t k = 0; k < 2; ++k)
          stack_.push_back({a.first + k, p.b, frame.into(nodes_a[a.first + k].centre), p.at_b});
      } else {
        for (std::uint32_t k = 0; k < 2; ++k)
          stack_.push_back({p.a, b.first + k, p.at_a, turn_ * nodes_b[b.first + k].centre});
      }
    }
    return true;
  }

  template <class Met>
  bool leaves(const Node& a, const Node& b, Met& met) {
    const TriangleMesh& mesh = hybrid_->nesting_->outer();
    for (std::uint32_t j = 0; j < b.count; ++j) {
      const std::uint32_t t = hybrid_->inner_.order()[b.first + j];
      SweptTriangle swept_t = swept(t);
      if (swept_t.edge_on()) continue;
      for (std::uint32_t i = 0; i < a.count; ++i) {
        const Triangle& u = mesh.triangles[hybrid_->outer_.order()[a.first + i]];
        for (std::size_t k = 0; k < 3; ++k) corner_[k] = frames_[half_].into(mesh.vertices[u[k]]);
        const auto x = swept_t.common_point(corner_[0], corner_[1], corner_[2]);
        if (!x) continue;
        if (!met(swept_t, *x, t)) return false;
        swept_t = swept(t);
      }
    }
    return true;
  }

  /// Lowers the scale until triangle t of B no longer meets the triangle corner_ of A in x. @return whether
  /// more is to be looked at
  bool pass_by(const Vec3& x, std::uint32_t t, std::vector<Vec3>& deciding) {
    // Where whole parts are in the way a point of the triangle finds a way down through them.
    const TriangleMesh& mesh = hybrid_->nesting_->inner();
    const Vec3 top = swept(t).top(x);
    lower(turn_.transpose() * (top - shift_) / scale_, deciding);
    for (const std::uint32_t v : mesh.triangles[t]) lower(mesh.vertices[v], deciding);
    // What is left is an interval of scales.
    const auto meets = [&] {
      const SweptTriangle now = swept(t);
      return !now.edge_on() && now.common_point(corner_[0], corner_[1], corner_[2]);
    };
    if (scale_ <= enough_) return false;
    if (!meets()) return true;
    double low = 0, high = scale_;
    while (high - low > step_) {
      scale_ = 0.5 * (low + high);
      (meets() ? high : low) = scale_;
    }
    scale_ = low;
    return scale_ > enough_;
  }

  const Hybrid* hybrid_;
  const Placement* placement_;
  WayOut way_;
  double scale_, step_ = 0, enough_ = 0;
  HalfFrame frames_[2];
  int half_ = 0;
  Eigen::Matrix3d turn_;
  Vec3 shift_;
  std::array<Vec3, 3> corner_;
  std::vector<Pair> stack_;

 public:
  long visited_ = 0;
};

Hybrid::Hybrid(const Nesting& nesting)
    : nesting_(&nesting),
      outer_(nesting.outer()),
      inner_(nesting.inner()),
      rays_(nesting.outer()),
      shells_(vertex_of_each_shell(nesting.inner())),
      witnesses_(spread_points(nesting.inner(), most_witnesses)) {}

Verdict Hybrid::check(const Placement& placement) {
  require_valid(placement);
  return Descent(*this, placement).check();
}

std::vector<Verdict> Hybrid::check(std::span<const Placement> placements) {
  for (const Placement& placement : placements) require_valid(placement);
  std::vector<Verdict> verdicts(placements.size());
  parallel_for(placements.size(),
               [&](std::size_t i) { verdicts[i] = Descent(*this, placements[i]).check(); });
  return verdicts;
}

FoundScale Hybrid::search_one(const Placement& placement, const SearchLimits& limits,
                              std::vector<Vec3>& deciding) const {
  return Descent(*this, placement).search(limits, deciding);
}

void Hybrid::learn(const std::vector<Vec3>& deciding) {
  if (deciding.empty()) return;
  const Vec3& last = deciding.back();
  std::erase(witnesses_, last);
  witnesses_.insert(witnesses_.begin(), last);
  if (witnesses_.size() > most_witnesses) witnesses_.pop_back();
}

FoundScale Hybrid::search(const Placement& placement, const SearchLimits& limits) {
  return search(std::span(&placement, 1), std::span(&limits, 1)).front();
}

std::vector<FoundScale> Hybrid::search(std::span<const Placement> placements,
                                       std::span<const SearchLimits> limits) {
  for (Placement placement : placements) {
    placement.pose.scale = 1;  // is not looked at
    require_valid(placement);
  }
  for (const SearchLimits& l : limits) require_valid(l);
  std::vector<FoundScale> found(placements.size());
  std::vector<std::vector<Vec3>> deciding(placements.size());
  parallel_for(placements.size(),
               [&](std::size_t i) { found[i] = search_one(placements[i], limits[i], deciding[i]); });
  for (const auto& points : deciding) learn(points);
  return found;
}

}  // namespace kreisel::nest
