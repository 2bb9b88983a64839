// least_move.hpp - of all motions that meet given rows, the one that moves a body least.
#pragma once

#include <memory>
#include <vector>

#include "deform/handle_motion.hpp"
#include "deform/nearest_point.hpp"

namespace kreisel::core {

/// What a motion must not do, and what counts as little. Body units.
struct MoveOptions {
  double least_determinant = 0.5;  ///< of the motion's derivative
  double bending = 0.02;           ///< weight of bending beside the displacement
  bool held =
      false;  ///< whether something stays where it is: else where the body is as a whole counts nothing
};

/// The handles of one body, the energy of their motion, and the rows that every motion must meet: what rests
/// on the anchor does not dip below it, and space is shrunk to no less than a share.
///
/// Energy is a p-norm of the displacements of vertices spread over the surface, nearly the largest of them,
/// and a little bending, so that there is one motion that has least.
class LeastMove {
 public:
  /// @param mesh, handles  outlive it
  LeastMove(const TriangleMesh& mesh, const Handles& handles, const Vec3& anchor, const MoveOptions& options);

  [[nodiscard]] const HandleMotion& motion() const { return motion_; }
  [[nodiscard]] double longest_side() const { return side_; }
  [[nodiscard]] bool held() const { return options_.held; }
  /// Of every vertex: seen from what is held, else up to a translation.
  [[nodiscard]] Eigen::MatrixX3d displacement(const Eigen::MatrixX3d& u) const;
  [[nodiscard]] double largest(const Eigen::MatrixX3d& u) const {
    return displacement(u).rowwise().norm().maxCoeff();
  }
  [[nodiscard]] double least_determinant(const Eigen::MatrixX3d& u) const { return determinants_.least(u); }

  /// From u towards the least motion that meets the rows, too. @param most  as far as any vertex goes
  [[nodiscard]] Eigen::MatrixX3d step(const Eigen::MatrixX3d& u, const HandleRows& rows, double most);
  /// From u down a slope, within the rows and so that nothing is displaced by more than `within`.
  [[nodiscard]] Eigen::MatrixX3d descend(const Eigen::MatrixX3d& u, const Eigen::MatrixX3d& slope,
                                         const HandleRows& rows, double within, double most) const;

 private:
  /// A vertex that might come to lie too low.
  struct Low {
    double height;        ///< above the anchor, undeformed
    Eigen::VectorXd row;  ///< of its motion
  };
  void find_low(const TriangleMesh& mesh, const Vec3& anchor);
  /// Adds what must be met wherever one goes from `from` to `to`.
  void add_own(HandleRows& rows, const Eigen::MatrixX3d& from, const Eigen::MatrixX3d& to) const;
  void emphasise(const Eigen::MatrixX3d& u);
  [[nodiscard]] Eigen::MatrixXd energy(const Eigen::VectorXd& emphasis) const;
  [[nodiscard]] Eigen::MatrixX3d cut_short(const Eigen::MatrixX3d& from, const Eigen::MatrixX3d& to,
                                           double most) const;

  MoveOptions options_;
  double side_;
  HandleMotion motion_;
  std::vector<Eigen::Index> spread_;  ///< vertices spread over the surface
  Determinants determinants_;
  std::vector<Low> low_;
  Eigen::MatrixXd rows_;  ///< of the motion of those spread
  Eigen::MatrixXd bending_;
  Eigen::VectorXd emphasis_;  ///< of those spread
};

}  // namespace kreisel::core
