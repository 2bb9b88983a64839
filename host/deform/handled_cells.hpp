// handled_cells.hpp - cells of an interior and the handles that move the body, in one problem. [SpinIt, s. 6]
#pragma once

#include <memory>

#include "body/body.hpp"
#include "deform/moved_cells.hpp"
#include "deform/surface_energy.hpp"
#include "device/device.hpp"
#include "formulation/formulation.hpp"

namespace kreisel::core {

/// x = (fills of the cells, y of the handles). A point v goes to v + sum_j w_j(v) (u_j v + t_j), less what
/// the anchor does: vertices of the skin and nodes of the cage's grid, with all that is between those. (u, t)
/// = C y, with C such that the regularisers of the surface are c |y|^2 / 2: each y counts alike then, and as
/// much as the fill of a cell, so that L-BFGS has one scale to find. All other is as of the cells alone:
/// their regulariser, their refinement.
///
///     s(x) = s_skin(y) + (light - 1) s_interior(y) + contrast sum_k x_k s_k(y)
class HandledCells final : public Formulation {
 public:
  /// @param body    undeformed  @param domain  of its interior; both outlive it, as does the device
  /// @param cells   a formulation whose variables are the fills of cells()
  /// @param cage    its grid's cells are filled by the domain's voxels
  /// @param energy  surface_energy() of the cage
  HandledCells(const Body& body, const Columns& domain, std::unique_ptr<Formulation> cells,
               std::shared_ptr<const WeightedCage> cage, const Eigen::MatrixXd& energy, const Vec3& anchor,
               device::Device& device);

  /// (u, t) of the handles.
  [[nodiscard]] ScaledHandles handles(std::span<const double> x) const;
  [[nodiscard]] TriangleMesh skin(const ScaledHandles& h) const;
  /// x^T R x / 2 of the handles.
  [[nodiscard]] double energy(std::span<const double> x) const;

  std::string_view name() const override { return cells_->name(); }
  std::size_t num_variables() const override { return fills() + moving(); }
  const Bounds& bounds() const override { return bounds_; }
  std::size_t moving() const override { return static_cast<std::size_t>(units_.cols()); }
  Moments moments(std::span<const double> x) override;
  void pull_back(std::span<const double> x, std::span<const Moments> weights, std::span<double> out) override;
  void curvature(std::span<const double>, const Moments&, std::span<double> out) override;
  Moments moved(std::span<const double> x) override;
  void add_moved(std::span<const double> x, std::span<const Moments> weights, std::span<double> out) override;
  const SparseForm* regulariser() const override { return &regulariser_; }
  bool refines() const override { return cells_->refines(); }
  bool refine(std::vector<double>& x) override;
  void restart() override;
  CellCounts count_cells(std::span<const double> x) const override { return cells_->count_cells(first(x)); }
  std::vector<Cube> cells() const override { return cells_->cells(); }
  SettingTexts settings() const override { return cells_->settings(); }
  Rounded round(std::span<const double> x) const override { return cells_->round(first(x)); }
  std::vector<double> start(Start where) const override;

 private:
  [[nodiscard]] std::size_t fills() const { return cells_->num_variables(); }
  [[nodiscard]] std::span<const double> first(std::span<const double> x) const { return x.first(fills()); }
  /// What follows from the cells that there are.
  void update();
  /// What follows from where the handles are, unless it is known.
  void move(std::span<const double> x);
  /// The derivative in (u, t) of what has the derivative `gradient` in points, whose weights are rows.
  template <class Points, class Gradient>
  [[nodiscard]] Eigen::VectorXd of_points(const Eigen::SparseMatrix<double, Eigen::RowMajor>& weights,
                                          const Points& points, const Gradient& gradient) const;
  /// Where (u, t) move points, whose weights are rows.
  template <class Points>
  [[nodiscard]] NodeMotion displaced(const Eigen::SparseMatrix<double, Eigen::RowMajor>& weights,
                                     const Points& points, const ScaledHandles& h) const;

  const Body& body_;
  std::unique_ptr<Formulation> cells_;
  std::shared_ptr<const WeightedCage> cage_;
  device::Device& device_;
  MovedCells moved_cells_;
  MovedCells interior_;      ///< all of it as one cell
  std::vector<Vec3> nodes_;  ///< of the cage's grid
  Vec3 anchor_;
  Eigen::MatrixXd of_anchor_;                               ///< (3, 4 handles)
  Eigen::SparseMatrix<double, Eigen::RowMajor> of_vertex_;  ///< weights, (vertices, handles)
  double light_;                                            ///< less 1
  double unit_;                                             ///< c
  Eigen::MatrixXd units_;                                   ///< C
  SparseForm regulariser_;
  Bounds bounds_;

  Eigen::VectorXd at_;  ///< the y that all below is of
  NodeMotion motion_;
  TriangleMesh skin_;
  Eigen::Matrix<double, 10, Eigen::Dynamic> of_cells_;
  Moments fixed_, fixed_before_;
};

}  // namespace kreisel::core
