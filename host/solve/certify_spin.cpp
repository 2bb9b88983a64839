#include "solve/certify_spin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "control.hpp"

namespace kreisel::core {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The centre of mass as low (sign 1) or as high (-1) as the constraints allow: what is least is sign c_z.
class Height final : public Problem {
 public:
  Height(const LinearConstraints& constraints, double sign) : constraints_(constraints), sign_(sign) {}
  [[nodiscard]] std::string_view name() const override { return "height"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::fractional; }
  [[nodiscard]] double value(const Moments& s) const override { return sign_ * s[SZ] / s[S1]; }
  [[nodiscard]] Moments gradient(const Moments& s) const override {
    Moments g = Moments::Zero();
    g[SZ] = sign_ / s[S1];
    g[S1] = -value(s) / s[S1];
    return g;
  }
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override {
    const Moments g = gradient(s), mass = Moments::Unit(S1);
    return -(g * mass.transpose() + mass * g.transpose()) / s[S1];
  }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] Verdict verify(const Moments&, double) const override { return {}; }

 private:
  const LinearConstraints& constraints_;
  double sign_;
};

/// Of searches: bounds are found again in double, whatever the device has.
double search_tolerance(const device::Device& device) { return device.single() ? 1e-8 : 1e-12; }

struct Node {
  CertifiedBox box;
  MomentPoint point;  ///< of the search in this box, or in the one that it was cut from
  BoxMultipliers multipliers;
  bool solved = false;
};

class Tree {
 public:
  Tree(Certificate& certificate, const Spinning& problem, const Task& task, const SafeSupport& support,
       const CertifyOptions& options)
      : c_(certificate),
        problem_(problem),
        support_(support),
        oracle_(*task.formulation.oracle(), task.mass, 0, options.stop),
        options_(options),
        tolerance_(search_tolerance(task.device)) {}

  void start(const Outcome& outcome, const MassModel& mass, const Moments& solid);
  void grow(const std::function<double()>& spent);
  void finish();

 private:
  [[nodiscard]] double wanted() const { return c_.best - options_.gap * std::abs(c_.best); }
  CertifiedBox beyond(double sign, const MomentPoint& from);
  Node node(const SpinRegion& region, const Node& near);
  [[nodiscard]] std::vector<double> first_moments() const;
  [[nodiscard]] std::pair<SpinRegion, SpinRegion> halves(const CertifiedBox& box) const;
  void solve(Node& node);
  void try_point(const MomentPoint& point);

  Certificate& c_;
  const Spinning& problem_;
  const SafeSupport& support_;
  TotalSupport oracle_;
  const CertifyOptions& options_;
  double tolerance_;
  Eigen::Vector2d range_ = {1, 1};  ///< of heights and first moments, to begin with
  std::vector<Node> nodes_;
  std::vector<CertifiedBox> outside_;
};

/// The half-infinite box of heights that no filling reaches.
CertifiedBox Tree::beyond(double sign, const MomentPoint& from) {
  const Height height(problem_.constraints(), sign);
  MomentPoint point = from;
  point.multipliers.setZero(4);
  point.active.clear();
  (void)find_stationary(height, oracle_, tolerance_, 40, point);
  const Moments forms = sign * Moments::Unit(SZ);
  const auto outside = [&](double end) {
    return sign > 0 ? SpinRegion{-infinity, end} : SpinRegion{-end, infinity};
  };
  BoxMultipliers m;
  m.mu = point.multipliers * point.s[S1];
  (sign > 0 ? m.nu_high : m.nu_low) = 1;
  const Moments above = forms + problem_.constraints().matrix.transpose() * m.mu;
  const auto bound = support_.largest_ratio(above, Moments::Unit(S1), height.value(point.s));
  // The geometry bounds it where the search does not: no multipliers, and the lowest or highest point.
  CertifiedBox box;
  if (bound) {
    // Once more with the quadric as the record has it: scaled, and in another order of operations.
    for (double end = *bound, step = 1e-14; step < 1; end -= step, step *= 2) {
      box = certify_box(support_, problem_.weights(), outside(end), m);
      if (box.empty) return box;
    }
  }
  m.mu.setZero();
  const auto plain = support_.largest_ratio(forms, Moments::Unit(S1), height.value(point.s));
  for (double end = plain.value_or(-1e3), step = 1e-14; step < 1e6; end -= step, step *= 2) {
    box = certify_box(support_, problem_.weights(), outside(end), m);
    if (box.empty) break;
  }
  return box;
}

/// A better incumbent from a point of a box, by a search of the whole problem from there.
void Tree::try_point(const MomentPoint& near) {
  constexpr double met = 1e-9;
  const Moments& s = near.s;
  if ((problem_.constraints().matrix * s).lpNorm<Eigen::Infinity>() > 1e-6) return;
  if (!(problem_.value(s) < c_.best - 1e-6 * std::abs(c_.best))) return;
  MomentPoint point = near;
  point.multipliers.setZero(4);
  point.active.clear();
  const Phase phase = find_stationary(problem_, oracle_, tolerance_, 100, point);
  if (phase == Phase::infeasible || phase == Phase::interrupted) return;
  const Moments reached = oracle_(point.q, false).moments;
  const double f = problem_.value(reached);
  if (!(f < c_.best) || violation(problem_, reached) > met) return;
  c_.best = f;
  const Moments x = point.q / std::max(point.q.cwiseAbs().maxCoeff(), 1e-300);
  c_.best_x.assign(x.data(), x.data() + 10);
}

void Tree::solve(Node& n) {
  ++c_.searches;
  n.solved = true;
  const BoxMinimum minimum = minimise_box(oracle_, problem_.weights(), n.box.region(), n.point, tolerance_);
  const CertifiedBox box = certify_box(support_, problem_.weights(), n.box.region(), minimum.multipliers);
  if (minimum.empty) {
    if (box.empty) n.box = box;
    return;
  }
  n.point = minimum.point;
  if (box.value > n.box.value) {
    n.box = box;
    n.multipliers = minimum.multipliers;
  }
  try_point(minimum.point);
}

/// A box, at first with what its neighbour's multipliers prove, which may do.
Node Tree::node(const SpinRegion& region, const Node& near) {
  Node n;
  n.point = near.point;
  n.multipliers = near.multipliers;
  n.box = certify_box(support_, problem_.weights(), region, near.multipliers);
  if (n.box.value < wanted()) solve(n);
  return n;
}

void Tree::start(const Outcome& outcome, const MassModel& mass, const Moments& solid) {
  Node seed;
  seed.point.s = outcome.moments;
  seed.point.multipliers.setZero(4);
  outside_ = {beyond(1, seed.point), beyond(-1, seed.point)};
  const double low = outside_[0].high, high = outside_[1].low;
  // So narrow that the secant's inertia is at least half the true one, which is least for the shell alone:
  // the ratio to minimise is nowhere zero.
  const double height = mass.fixed[S1] > 0 ? mass.fixed[SZ] * mass.fixed[SZ] / mass.fixed[S1] : 0;
  const double least = mass.fixed[SZZ] + std::min(mass.fixed[SXX], mass.fixed[SYY]) - height;
  const double width = std::sqrt(2 * std::max(least, 0.0) / solid[S1]);
  constexpr int most = 12;
  const double range = std::max(high - low, 0.0);
  const int count =
      width > 0 ? static_cast<int>(std::clamp(std::ceil(range / width), 1.0, double(most))) : most;
  const double c = outcome.moments[SZ] / outcome.moments[S1];
  const int middle = std::clamp(static_cast<int>((c - low) / range * count), 0, count - 1);
  const auto end = [&](int i) { return i == count ? high : low + range * i / count; };
  const std::vector<double> cuts = first_moments();
  range_ = {range, cuts.back() - cuts.front()};
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    std::vector<Node> level(static_cast<std::size_t>(count));
    const auto at = [&](int i) -> Node& { return level[static_cast<std::size_t>(i)]; };
    const auto cut = [&](int i, const Node& near) {
      at(i) = node({end(i), end(i + 1), cuts[k], cuts[k + 1]}, near);
    };
    // From the solution outwards, so that each has a neighbour to start from.
    cut(middle, seed);
    for (int i = middle + 1; i < count; ++i) cut(i, at(i - 1));
    for (int i = middle - 1; i >= 0; --i) cut(i, at(i + 1));
    nodes_.insert(nodes_.end(), level.begin(), level.end());
  }
}

/// Where the first moments are cut to begin with: at the ends of what any filling has. Beyond the outermost,
/// sz^2 alone is worth more than the best.
std::vector<double> Tree::first_moments() const {
  const SpinRegion any;
  if (!(c_.sz_most > 0)) return {any.sz_low, any.sz_high};
  std::vector<double> cuts = {-c_.sz_most, c_.sz_most};
  for (const double sign : {1.0, -1.0}) {
    const SafeSupport::Value value = support_.at(sign * Moments::Unit(SZ));
    const double cut = sign * (value.h - 4 * value.margin);
    if (std::abs(cut) < c_.sz_most) cuts.push_back(cut);
  }
  std::ranges::sort(cuts);
  return cuts;
}

/// Cut across the side that is longer, as a share of what the tree began with.
std::pair<SpinRegion, SpinRegion> Tree::halves(const CertifiedBox& box) const {
  SpinRegion lower = box.region(), upper = lower;
  if (lower.confines_sz() &&
      (lower.sz_high - lower.sz_low) * range_[0] > (lower.high - lower.low) * range_[1])
    lower.sz_high = upper.sz_low = (lower.sz_low + lower.sz_high) / 2;
  else
    lower.high = upper.low = (lower.low + lower.high) / 2;
  return {lower, upper};
}

void Tree::grow(const std::function<double()>& spent) {
  for (;;) {
    if (options_.stop.stop_requested()) throw Interrupted();
    const auto worst = std::ranges::min_element(nodes_, {}, [](const Node& n) { return n.box.value; });
    if (worst->box.value >= wanted()) return;
    if (!worst->solved) {
      solve(*worst);
      continue;
    }
    if (spent() > options_.seconds) {
      c_.message = fmt::format("{:g} seconds were spent", options_.seconds);
      return;
    }
    if (static_cast<int>(nodes_.size()) >= options_.most_boxes) {
      c_.message = fmt::format("{} boxes were cut", nodes_.size());
      return;
    }
    const Node parent = *worst;
    const auto [lower, upper] = halves(parent.box);
    if (!(lower.low < lower.high && upper.low < upper.high && lower.sz_low < lower.sz_high &&
          upper.sz_low < upper.sz_high)) {
      c_.message = "a box cannot be cut further";
      return;
    }
    nodes_.erase(worst);
    for (const SpinRegion& half : {lower, upper}) nodes_.push_back(node(half, parent));
  }
}

void Tree::finish() {
  c_.boxes = outside_;
  for (const Node& n : nodes_) c_.boxes.push_back(n.box);
  std::ranges::sort(c_.boxes, {}, [](const CertifiedBox& b) { return std::pair(b.low, b.sz_low); });
  c_.bound = c_.sz_most > 0 ? c_.spin.moment * c_.sz_most * c_.sz_most * (1 - 1e-15) : infinity;
  for (const CertifiedBox& box : c_.boxes) c_.bound = std::min(c_.bound, box.value);
}

}  // namespace

void certify_spin(Certificate& certificate, const Spinning& problem, const Task& task,
                  const SafeSupport& support, const Outcome& outcome, const CertifyOptions& options,
                  const std::function<double()>& spent) {
  // f is no less than its term of sz^2. A little more than the best, so that the term is not what bounds f.
  const double moment = problem.weights().moment;
  certificate.sz_most =
      moment > 0 && std::isfinite(certificate.best) ? std::sqrt(1.001 * certificate.best / moment) : 0;
  Tree tree(certificate, problem, task, support, options);
  const Moments solid = support.at(-Moments::Unit(S1)).s;
  tree.start(outcome, task.mass, solid);
  tree.grow(spent);
  tree.finish();
}

void certify_centred(Certificate& certificate, const Spinning& problem, const Task& task,
                     const SafeSupport& support, const Outcome& outcome) {
  TotalSupport oracle(*task.formulation.oracle(), task.mass, 0);
  MomentPoint near;
  near.s = outcome.moments;
  const SpinRegion origin{0, 0};
  const BoxMinimum minimum =
      minimise_box(oracle, problem.weights(), origin, near, search_tolerance(task.device));
  certificate.searches = 1;
  certificate.boxes = {certify_box(support, problem.weights(), origin, minimum.multipliers)};
  certificate.bound = certificate.boxes.front().value;
}

}  // namespace kreisel::core
