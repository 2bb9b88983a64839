#include "nest/decide/hybrid.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "nest/decide/exact.hpp"
#include "nest/decide/way_out.hpp"
#include "parallel.hpp"

namespace kreisel::core::nest {
namespace {

constexpr std::size_t most_witnesses = 48;
// Positions in single precision are right to this, in nesting units; A's nodes have room for it
// (sphere_tree.cpp).
constexpr float slack = 1e-6f;

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

/// One placement of the two trees. Nodes are compared in single precision with room for its rounding,
/// triangles in double.
class Hybrid::Descent {
 public:
  Descent(const Hybrid& hybrid, const Placement& placement)
      : hybrid_(&hybrid),
        placement_(&placement),
        way_(hybrid.rays_, placement),
        scale_(placement.pose.scale),
        frames_{view_of(placement.cut, 0), view_of(placement.cut, 1)} {}

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
  using Vec3f = Eigen::Vector3f;
  using Matrix3f = Eigen::Matrix3f;
  /// A half's frame, for nodes.
  struct View {
    Matrix3f axes, turn;  ///< of A's and of B's points
    Vec3f shift, normal;
    float offset, way;  ///< way along the removal direction for each unit beyond the cut
  };
  struct Pair {
    std::uint32_t a, b;
    Vec3f at_a, at_b;  ///< of A's sphere in the half's frame; of B's before it is scaled and moved
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

  /// Whether nothing in ball and slab of one node is in the way of what is in those of the other.
  [[nodiscard]] bool clear(const Pair& p, const Node& a, const Node& b) const {
    const float scale = float(scale_), radius = scale * b.radius, both = a.radius + radius;
    const Vec3f at_b = scale * p.at_b + view_.shift;
    if (view_.normal.dot(p.at_a) - view_.offset < -a.radius) return true;
    const float beyond = view_.normal.dot(at_b) - view_.offset;
    if (beyond < -radius - slack) return true;
    const Vec3f apart = p.at_a - at_b;
    const float above = std::max(apart.z(), 0.0f);  // A below B is in its way
    if (apart.head<2>().squaredNorm() + above * above > both * both) return true;
    // All that B sweeps on one side of A's slab: at both ends of the way to the cut, a ball's width further.
    const Vec3f na = view_.axes * a.normal;
    const float start = -na.dot(apart),
                end = start - na.z() * std::max(beyond + radius + slack, 0.0f) * view_.way;
    const float nearest = std::min(start, end), farthest = std::max(start, end);
    if (farthest + radius < a.least || nearest - radius > a.most) return true;
    // A above the slab of an upper side of B.
    const Vec3f nb = view_.turn * b.normal;
    const bool upper_side = nb.z() >= 0;
    const float over = nb.dot(apart) - scale * b.most;
    if (upper_side && over > a.radius) return true;
    // Where both run nearly alike a node reaches much less far across the other's slab than its ball.
    const float along = na.dot(nb), across = na.cross(nb).norm() + slack;
    const auto [least, most] = reach(radius, scale * b.least, scale * b.most, along, across);
    if (farthest + most < a.least || nearest + least > a.most) return true;
    return upper_side && over + reach(a.radius, a.least, a.most, along, across).first > 0;
  }

  /// How far what is in a ball and a slab about its centre reaches along a direction: back, and on.
  /// @param along, across  of the slab's normal, seen from the direction: cosine and sine
  [[nodiscard]] static std::pair<float, float> reach(float radius, float least, float most, float along,
                                                     float across) {
    const float low = std::min(along * least, along * most), high = std::max(along * least, along * most);
    return {std::max(-radius, low - across * radius), std::min(radius, high + across * radius)};
  }

  /// Goes through the pairs of triangles that meet; `met` says whether to go on. @return whether it did to
  /// the end
  template <class Met>
  bool pass(Met&& met) {
    const HalfView& frame = frames_[half_];
    turn_ = frame.axes * placement_->pose.rotation;
    shift_ = frame.into(placement_->pose.centroid);
    view_ = {frame.axes.cast<float>(),       turn_.cast<float>(),     shift_.cast<float>(),
             frame.cut.normal.cast<float>(), float(frame.cut.offset), float(1 / frame.cut.normal.z())};
    const auto &nodes_a = hybrid_->outer_.nodes(), &nodes_b = hybrid_->inner_.nodes();
    stack_.assign(1, {0, 0, view_.axes * nodes_a[0].centre, view_.turn * nodes_b[0].centre});
    while (!stack_.empty()) {
      const Pair p = stack_.back();
      stack_.pop_back();
      const Node &a = nodes_a[p.a], &b = nodes_b[p.b];
      if (clear(p, a, b)) continue;
      if (a.is_leaf() && b.is_leaf()) {
        if (!leaves(a.first, b.first, met)) return false;
      } else if (b.is_leaf() || (!a.is_leaf() && a.radius > float(scale_) * b.radius)) {
        for (std::uint32_t k = 0; k < 2; ++k)
          stack_.push_back({a.first + k, p.b, view_.axes * nodes_a[a.first + k].centre, p.at_b});
      } else {
        for (std::uint32_t k = 0; k < 2; ++k)
          stack_.push_back({p.a, b.first + k, p.at_a, view_.turn * nodes_b[b.first + k].centre});
      }
    }
    return true;
  }

  template <class Met>
  bool leaves(std::uint32_t u, std::uint32_t t, Met& met) {
    const SweptTriangle swept_t = swept(t);
    if (swept_t.edge_on()) return true;
    const TriangleMesh& mesh = hybrid_->nesting_->outer();
    for (std::size_t k = 0; k < 3; ++k) corner_[k] = frames_[half_].into(mesh.vertices[mesh.triangles[u][k]]);
    const auto x = swept_t.common_point(corner_[0], corner_[1], corner_[2]);
    return !x || met(swept_t, *x, t);
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
  HalfView frames_[2];
  int half_ = 0;
  Eigen::Matrix3d turn_;
  Vec3 shift_;
  View view_;
  std::array<Vec3, 3> corner_;
  std::vector<Pair> stack_;
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

}  // namespace kreisel::core::nest
