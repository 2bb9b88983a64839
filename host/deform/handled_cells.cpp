#include "deform/handled_cells.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "body/mesh_moments.hpp"
#include "body/mesh_moments_gradient.hpp"
#include "parallel.hpp"

namespace kreisel::core {
namespace {

auto of_row(const NodeMotion& gradient) {
  return [&gradient](Eigen::Index i) -> Vec3 { return gradient.row(i).transpose(); };
}

}  // namespace

HandledCells::HandledCells(const Body& body, const Columns& domain, std::unique_ptr<Formulation> cells,
                           std::shared_ptr<const WeightedCage> cage, const Eigen::MatrixXd& energy,
                           const Vec3& anchor, device::Device& device)
    : body_(body),
      cells_(std::move(cells)),
      cage_(std::move(cage)),
      device_(device),
      moved_cells_(cage_->cage, domain),
      interior_(cage_->cage, domain),
      anchor_(anchor),
      light_(std::min(body.interior_density, body.void_density) / body.density - 1) {
  for (const Cage::Place& node : cage_->cage.nodes()) nodes_.push_back(cage_->cage.position(node));
  const CageHandles handles(cage_);
  of_anchor_ = displacement_rows(handles.at(anchor), anchor, handles.count());
  const TriangleMesh& mesh = body.local;
  std::vector<HandleWeights> weights(mesh.vertices.size());
  parallel_for(weights.size(), 256, [&](std::size_t v) { weights[v] = handles.at(mesh.vertices[v]); });
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t v = 0; v < weights.size(); ++v)
    for (const HandleWeight& w : weights[v])
      entries.emplace_back(static_cast<Eigen::Index>(v), w.handle, w.weight);
  of_vertex_.resize(static_cast<Eigen::Index>(mesh.vertices.size()),
                    static_cast<Eigen::Index>(handles.count()));
  of_vertex_.setFromTriplets(entries.begin(), entries.end());

  const int whole = 1 << octree_levels(domain.grid);
  const Cube all{0, 0, 0, static_cast<std::uint16_t>(whole)};
  interior_.set({&all, 1});

  unit_ = domain.interior[S1] / static_cast<double>(cells_->num_variables());
  Eigen::MatrixXd definite = energy;
  definite.diagonal().array() += 1e-9 * energy.trace() / static_cast<double>(energy.rows());
  // energy = K K^T, y = K^T h / sqrt(c)
  const Eigen::LLT<Eigen::MatrixXd> factors(definite);
  units_ =
      std::sqrt(unit_) * factors.matrixU().solve(Eigen::MatrixXd::Identity(energy.rows(), energy.cols()));
  restart();
}

std::vector<double> HandledCells::start(Start where) const {
  std::vector<double> x = cells_->start(where);
  x.resize(x.size() + moving(), 0.0);
  return x;
}

ScaledHandles HandledCells::handles(std::span<const double> x) const {
  return units_ * Eigen::Map<const Eigen::VectorXd>(x.data() + fills(), units_.cols());
}

double HandledCells::energy(std::span<const double> x) const {
  return unit_ * Eigen::Map<const Eigen::VectorXd>(x.data() + fills(), units_.cols()).squaredNorm() / 2;
}

template <class Points>
NodeMotion HandledCells::displaced(const Eigen::SparseMatrix<double, Eigen::RowMajor>& weights,
                                   const Points& points, const ScaledHandles& h) const {
  using Fours = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
  const Eigen::RowVector3d back = (of_anchor_ * h).transpose();
  const Fours each = weights * Eigen::Map<const Fours>(h.data(), weights.cols(), 4);
  NodeMotion result(each.rows(), 3);
  for (Eigen::Index i = 0; i < each.rows(); ++i)
    result.row(i) =
        each(i, 0) * points[static_cast<std::size_t>(i)].transpose() + each.row(i).tail<3>() - back;
  return result;
}

template <class Points, class Gradient>
Eigen::VectorXd HandledCells::of_points(const Eigen::SparseMatrix<double, Eigen::RowMajor>& weights,
                                        const Points& points, const Gradient& gradient) const {
  using Fours = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
  Fours each(weights.rows(), 4);
  Vec3 total = Vec3::Zero();
  for (Eigen::Index i = 0; i < each.rows(); ++i) {
    const Vec3 g = gradient(i);
    each.row(i) << g.dot(points[static_cast<std::size_t>(i)]), g.transpose();
    total += g;
  }
  const Fours of_handles = weights.transpose() * each;
  return Eigen::Map<const Eigen::VectorXd>(of_handles.data(), of_handles.size()) -
         of_anchor_.transpose() * total;
}

TriangleMesh HandledCells::skin(const ScaledHandles& h) const {
  TriangleMesh mesh = body_.local;
  const NodeMotion by = displaced(of_vertex_, body_.local.vertices, h);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    mesh.vertices[v] += by.row(static_cast<Eigen::Index>(v)).transpose();
  return mesh;
}

void HandledCells::update() {
  moved_cells_.set(cells_->cells());
  bounds_ = cells_->bounds();
  // Far beyond where the regulariser would let them.
  const double far = std::sqrt(2 * 1e1 / unit_);
  bounds_.lower.resize(fills() + moving(), -far);
  bounds_.upper.resize(fills() + moving(), far);
  regulariser_ = cells_->regulariser() ? *cells_->regulariser() : SparseForm();
  for (std::size_t k = fills(); k < num_variables(); ++k)
    regulariser_.entries.push_back({static_cast<int>(k), static_cast<int>(k), unit_});
  at_.resize(0);
}

void HandledCells::move(std::span<const double> x) {
  const Eigen::Map<const Eigen::VectorXd> y(x.data() + fills(), units_.cols());
  if (at_.size() == y.size() && at_ == y) return;
  const ScaledHandles h = units_ * y;
  motion_ = displaced(cage_->biharmonic.weights, nodes_, h);
  skin_ = skin(h);
  of_cells_ = moved_cells_.moments(motion_);
  fixed_ = reference::mesh_moments(skin_).value + light_ * of_cells_.rowwise().sum();
  at_ = y;
}

void HandledCells::restart() {
  cells_->restart();
  update();
  const std::vector<double> x = start(Start::middle);
  move(x);
  fixed_before_ = fixed_;
}

bool HandledCells::refine(std::vector<double>& x) {
  std::vector<double> fill(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(fills()));
  const std::vector<double> y(x.begin() + static_cast<std::ptrdiff_t>(fills()), x.end());
  const bool due = cells_->refine(fill);
  x = std::move(fill);
  x.insert(x.end(), y.begin(), y.end());
  update();
  return due;
}

Moments HandledCells::moments(std::span<const double> x) {
  move(x);
  return of_cells_ * Eigen::Map<const Eigen::VectorXd>(x.data(), of_cells_.cols());
}

Moments HandledCells::moved(std::span<const double> x) {
  move(x);
  return fixed_ - fixed_before_;
}

void HandledCells::pull_back(std::span<const double> x, std::span<const Moments> weights,
                             std::span<double> out) {
  move(x);
  const std::vector<NodeMotion> gradient = moved_cells_.gradient(motion_, first(x), weights);
  for (std::size_t r = 0; r < weights.size(); ++r) {
    double* row = out.data() + r * num_variables();
    Eigen::Map<Eigen::VectorXd>(row, of_cells_.cols()).noalias() = of_cells_.transpose() * weights[r];
    Eigen::Map<Eigen::VectorXd>(row + fills(), units_.cols()).noalias() =
        units_.transpose() * of_points(cage_->biharmonic.weights, nodes_, of_row(gradient[r]));
  }
}

void HandledCells::add_moved(std::span<const double> x, std::span<const Moments> weights,
                             std::span<double> out) {
  move(x);
  const std::vector<NodeMotion> gradient = interior_.gradient(motion_, {&light_, 1}, weights);
  for (std::size_t r = 0; r < weights.size(); ++r) {
    const std::vector<Vec3> of_skin = mesh_moments_gradient(skin_, weights[r], device_);
    Eigen::Map<Eigen::VectorXd>(out.data() + r * num_variables() + fills(), units_.cols()) +=
        units_.transpose() * (of_points(cage_->biharmonic.weights, nodes_, of_row(gradient[r])) +
                              of_points(of_vertex_, body_.local.vertices, [&](Eigen::Index v) {
                                return of_skin[static_cast<std::size_t>(v)];
                              }));
  }
}

void HandledCells::curvature(std::span<const double>, const Moments&, std::span<double> out) {
  std::ranges::fill(out, 0.0);
}

}  // namespace kreisel::core
