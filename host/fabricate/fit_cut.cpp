#include "fabricate/fit_cut.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/triangle.hpp"

namespace kreisel::core {
namespace {

Moments monomials(const Vec3& p) {
  Moments m;
  m << 1, p[0], p[1], p[2], p[0] * p[1], p[1] * p[2], p[0] * p[2], p[0] * p[0], p[1] * p[1], p[2] * p[2];
  return m;
}

Vec3 gradient(const Moments& q, const Vec3& p) {
  return {q[SX] + q[SXY] * p[1] + q[SXZ] * p[2] + 2 * q[SXX] * p[0],
          q[SY] + q[SXY] * p[0] + q[SYZ] * p[2] + 2 * q[SYY] * p[1],
          q[SZ] + q[SYZ] * p[1] + q[SXZ] * p[0] + 2 * q[SZZ] * p[2]};
}

/// A mesher puts vertices on the quadric to its last digits.
constexpr double on_it = 1e-9;

}  // namespace

void CutEffect::add(const Moments& at, const Vec3& way, const Vec3& area, double weight) {
  moments_ -= weight * area.dot(way) * at * at.transpose();
  squares_ += area.norm() * way.squaredNorm() * at * at.transpose();
}

Moments CutEffect::change_for(const Eigen::Matrix<double, Eigen::Dynamic, 10>& rows,
                              const Eigen::VectorXd& wanted) const {
  const Eigen::MatrixXd effect = rows * moments_;
  // A cut in one plane leaves some changes without any move: they cost nothing and do nothing.
  const Matrix10 some = squares_ + 1e-12 * squares_.trace() * Matrix10::Identity();
  const Eigen::MatrixXd back = some.ldlt().solve(effect.transpose());
  const Moments change = back * (effect * back).completeOrthogonalDecomposition().solve(wanted);
  return change.allFinite() ? change : Moments::Zero();
}

CutShift::CutShift(const Body& body, const Inside& inside, const Moments& q,
                   std::function<bool(const Vec3&)> keeps)
    : inside_(inside), keeps_(std::move(keeps)) {
  find(&Inside::voids, (body.one_material() ? 1 : 0) - body.void_density / body.density, q);
  find(&Inside::fill, body.interior_density / body.density, q);
}

void CutShift::find(TriangleMesh Inside::*which, double weight, const Moments& q) {
  const TriangleMesh& mesh = inside_.*which;
  std::vector<std::uint8_t> on(mesh.vertices.size()), within;
  for (std::size_t v = 0; v < on.size(); ++v) {
    const Vec3& p = mesh.vertices[v];
    on[v] = std::abs(q.dot(monomials(p))) <= on_it * gradient(q, p).norm();
  }
  within = on;
  std::vector<Vec3> area(mesh.vertices.size(), Vec3::Zero());  // a third of the triangles around, outward
  for (const Triangle& t : mesh.triangles) {
    const Vec3 third = normal_of(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]) / 6;
    const bool all = on[t[0]] && on[t[1]] && on[t[2]];
    for (const std::uint32_t v : t) {
      area[v] += third;
      within[v] = within[v] && all;
    }
  }
  for (std::uint32_t v = 0; v < within.size(); ++v) {
    const Vec3 slope = gradient(q, mesh.vertices[v]), way = slope / slope.squaredNorm();
    if (!within[v] || !way.allFinite()) continue;  // beside the cut, or the tip of a cone
    cut_.push_back({which, v, monomials(mesh.vertices[v]), way});
    effect_.add(cut_.back().at, way, area[v], weight);
  }
}

bool CutShift::toward(const LinearConstraints& rows, const Moments& whole) {
  const Eigen::VectorXd now = rows.matrix * whole;
  asked_.resize(static_cast<std::size_t>(now.size()));
  std::vector<Eigen::Index> active;
  for (Eigen::Index r = 0; r < now.size(); ++r) {
    const auto i = static_cast<std::size_t>(r);
    asked_[i] = asked_[i] || now[r] < rows.lower[r] || now[r] > rows.upper[r];
    if (asked_[i]) active.push_back(r);
  }
  if (active.empty()) return false;
  Eigen::VectorXd lacks(static_cast<Eigen::Index>(active.size()));
  for (Eigen::Index k = 0; k < lacks.size(); ++k) {
    const Eigen::Index r = active[static_cast<std::size_t>(k)];
    // Of a row held at one of its ends, that end.
    const bool at_lower = std::abs(now[r] - rows.lower[r]) < std::abs(rows.upper[r] - now[r]);
    lacks[k] = (now[r] > rows.upper[r] || !at_lower ? rows.upper[r] : rows.lower[r]) - now[r];
  }
  const Moments more = effect_.change_for(rows.matrix(active, Eigen::all), lacks);
  change_ += more;
  return !more.isZero(0);
}

double CutShift::most() const {
  double most = 0;
  for (const OnCut& c : cut_) most = std::max(most, std::abs(change_.dot(c.at)) * c.way.norm());
  return most;
}

Inside CutShift::shifted() const {
  Inside moved = inside_;
  for (const OnCut& c : cut_) {
    Vec3& p = (moved.*c.mesh).vertices[c.vertex];
    if (const Vec3 there = p - change_.dot(c.at) * c.way; keeps_(there)) p = there;
  }
  return moved;
}

}  // namespace kreisel::core
