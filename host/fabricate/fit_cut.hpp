// fit_cut.hpp - a part's cut moved a little, so that the mesh itself meets what was asked.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "fabricate/parts.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {

/// What a change d of the quadric q does, to first order: it moves the cut by -d(p) grad q / |grad q|^2.
class CutEffect {
 public:
  /// A part of the cut. @param at  its 1 x y z xy yz xz xx yy zz  @param way  grad q / |grad q|^2 there
  /// @param area  outward normal, as long as the area  @param weight  of what is behind it
  void add(const Moments& at, const Vec3& way, const Vec3& area, double weight);

  /// Of all d that change these rows of the moments so, the one that moves the cut least, in the mean square
  /// over its area. At an optimum each costs the objective the same. Zero where none does.
  [[nodiscard]] Moments change_for(const Eigen::Matrix<double, Eigen::Dynamic, 10>& rows,
                                   const Eigen::VectorXd& wanted) const;

 private:
  Matrix10 moments_ = Matrix10::Zero();  ///< of the whole, by d
  Matrix10 squares_ = Matrix10::Zero();  ///< d . squares d: mean square of the move, times the area
};

/// Moves the cut of a mesh a little, as the quadric q + d would: vertices on it whose neighbours are on it,
/// too. Vertices beside the wall stay, so that it does, and no edge of the mesh changes what it joins.
class CutShift {
 public:
  /// @param inside  kept; that q cut  @param q  body frame and units
  /// @param keeps   whether a vertex may lie there (far enough from the skin)
  CutShift(const Body& body, const Inside& inside, const Moments& q, std::function<bool(const Vec3&)> keeps);

  /// Moves it so that moments go from `whole` to where they meet the rows, as far as its areas tell; to be
  /// repeated. @return  false where nothing of the cut can be moved so
  bool toward(const LinearConstraints& rows, const Moments& whole);
  /// How far all moves took the cut where they took it farthest, body units.
  [[nodiscard]] double most() const;
  /// To add to the quadric: its zeros are where the cut has gone, to first order.
  [[nodiscard]] const Moments& change() const { return change_; }
  /// The inside with its cut where it is now.
  [[nodiscard]] Inside shifted() const;

 private:
  struct OnCut {
    TriangleMesh Inside::*mesh;
    std::uint32_t vertex;
    Moments at;  ///< 1 x y z xy yz xz xx yy zz
    Vec3 way;    ///< grad q / |grad q|^2
  };
  void find(TriangleMesh Inside::*mesh, double weight, const Moments& q);

  const Inside& inside_;
  std::function<bool(const Vec3&)> keeps_;
  std::vector<OnCut> cut_;
  CutEffect effect_;
  Moments change_ = Moments::Zero();
  std::vector<bool> asked_;  ///< rows that were missed once: they are held from then on
};

}  // namespace kreisel::core
