#include "deform/handled_cells.hpp"

#include <gtest/gtest.h>

#include "body/mesh_moments.hpp"
#include "body/source.hpp"
#include "deform/bodies.hpp"
#include "solve/solver.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Body leaning() {
  BodySpec spec;
  spec.density = 1;
  return make_body(spec, source_of(leaning_ellipsoid({14, 16, 30}, 50, 24)));
}

/// An ellipsoid with a cage of 4 cells along its longest side, a grid of 16 in them, and 16 or 32 voxels.
struct Handled {
  Body body = leaning();
  std::shared_ptr<const WeightedCage> cage = weighted_cage(body.local, 2, 4);
  Columns domain;
  std::unique_ptr<HandledCells> cells;
  MassModel mass;

  explicit Handled(const char* formulation, int finer = 1) {
    const CageGrid& grid = cage->cage.grid();
    GridSpec spec;
    spec.cells = {finer * grid.finer * grid.cells[0], finer * grid.finer * grid.cells[1],
                  finer * grid.finer * grid.cells[2]};
    domain = make_columns(body, spec, {1, Wall::cells});
    const Eigen::MatrixXd energy = surface_energy(body.local, CageHandles(cage), 0.01, 1);
    cells = std::make_unique<HandledCells>(body, domain,
                                           make_formulation(formulation, domain, {}, {}, test_device()), cage,
                                           energy, Vec3(0, 0, 0), test_device());
    mass = hollowed(body, domain.interior);
  }
  /// Some fills, and handles that are moved by some hundredths of the body.
  [[nodiscard]] std::vector<double> any_place() const {
    Random random(4);
    std::vector<double> x = cells->start(Start::middle);
    const std::size_t fills = x.size() - cells->moving();
    for (std::size_t k = 0; k < fills; ++k) x[k] = uniform(random, 0, 1);
    for (std::size_t k = fills; k < x.size(); ++k) x[k] = uniform(random, -1, 1);
    const double large = cells->energy(x);
    for (std::size_t k = fills; k < x.size(); ++k) x[k] *= std::sqrt(2e-3 / large);
    return x;
  }
};

TEST(HandledCells, AreTheCellsAloneWhereNothingMoves) {
  for (const char* formulation : {"octree", "voxel"}) {
    Handled of(formulation);
    const auto alone = make_formulation(formulation, of.domain, {}, {}, test_device());
    std::vector<double> x = of.any_place();
    ASSERT_EQ(alone->num_variables() + of.cells->moving(), x.size());
    std::fill(x.end() - static_cast<std::ptrdiff_t>(of.cells->moving()), x.end(), 0.0);
    const Moments want = alone->moments(std::span(x).first(alone->num_variables()));
    EXPECT_LT((of.cells->moments(x) - want).norm(), 1e-12 * want.norm());
    EXPECT_EQ(of.cells->moved(x), Moments(Moments::Zero()));
  }
}

TEST(HandledCells, HaveTheDerivativesOfTheirMoments) {
  Handled of("octree", 2);
  const std::unique_ptr<Problem> problem = find_problem("spin").make({}, of.body);
  const Task task{*problem, *of.cells, of.mass, test_device()};
  const std::vector<double> x = of.any_place();
  const std::vector<Moments> weights = {Moments(Moments::LinSpaced(-1, 2)), Moments(Moments::Unit(SXZ)),
                                        Moments(Moments::LinSpaced(1, -0.5))};
  std::vector<double> slope(weights.size() * x.size());
  task.pull_back(x, weights, slope);
  Random random(9);
  for (int one = 0; one < 4; ++one) {
    std::vector<double> along(x.size(), 0.0);
    const std::size_t fills = x.size() - of.cells->moving();
    // The fills alone, the handles alone, both.
    for (std::size_t k = one == 1 ? fills : 0; k < (one == 0 ? fills : x.size()); ++k)
      along[k] = uniform(random, -1, 1);
    const auto total = [&](double t) {
      std::vector<double> there = x;
      for (std::size_t k = 0; k < x.size(); ++k) there[k] += t * along[k];
      return task.total(there);
    };
    const double h = 1e-2;  // moments are cubic in the handles, nearly: differences of fourth order
    const Moments want = (8 * (total(h) - total(-h)) - (total(2 * h) - total(-2 * h))) / (12 * h);
    for (std::size_t r = 0; r < weights.size(); ++r) {
      double got = 0, size = 0;
      for (std::size_t k = 0; k < x.size(); ++k) {
        got += slope[r * x.size() + k] * along[k];
        size += std::abs(slope[r * x.size() + k] * along[k]);
      }
      EXPECT_NEAR(got, weights[r].dot(want), 1e-6 * size);
    }
  }
}

TEST(HandledCells, MoveAsOneWhereAllHandlesAreOne) {
  // All scales alike and all translations alike: the whole body grows about the anchor, skin and cells.
  Handled of("voxel");
  const std::size_t fills = of.cells->num_variables() - of.cells->moving();
  // One handle that is rigid stands for the closed form: x goes to (1 + u) x + t, less what the anchor does.
  const double u = 0.1;
  ScaledHandles h = ScaledHandles::Zero(static_cast<Eigen::Index>(of.cells->moving()));
  for (Eigen::Index j = 0; j < h.size(); j += 4) {
    h[j] = u;
    h.segment<3>(j + 1) = Vec3(0.3, -0.1, 0.2);
  }
  const TriangleMesh skin = of.cells->skin(h);
  for (std::size_t v = 0; v < skin.vertices.size(); ++v)
    EXPECT_LT((skin.vertices[v] - (1 + u) * of.body.local.vertices[v]).norm(), 1e-7);
  // In the variables of the solver: C^-1 h, by the columns of C.
  Eigen::MatrixXd units(h.size(), h.size());
  std::vector<double> x(of.cells->num_variables(), 0.5);
  std::fill(x.begin() + static_cast<std::ptrdiff_t>(fills), x.end(), 0.0);
  for (Eigen::Index k = 0; k < h.size(); ++k) {
    std::vector<double> one = x;
    one[fills + static_cast<std::size_t>(k)] = 1;
    units.col(k) = of.cells->handles(one);
  }
  const Eigen::VectorXd y = units.partialPivLu().solve(h);
  const Moments before = of.cells->moments(x);
  std::ranges::copy(y, x.begin() + static_cast<std::ptrdiff_t>(fills));
  const Moments after = of.cells->moments(x);
  const double g = 1 + u;
  for (int k = 0; k < 10; ++k)
    EXPECT_NEAR(after[k], std::pow(g, k == S1 ? 3 : k <= SZ ? 4 : 5) * before[k], 1e-6 * before.norm());
}

TEST(SurfaceEnergy, IsNothingForAWholeThatMovesAndTurnsALittle) {
  const Handled of("voxel");
  const Eigen::MatrixXd bent = surface_energy(of.body.local, CageHandles(of.cage), 1, 0),
                        far = surface_energy(of.body.local, CageHandles(of.cage), 0, 1);
  ScaledHandles moved = ScaledHandles::Zero(bent.rows()), grown = moved;
  for (Eigen::Index j = 0; j < moved.size(); j += 4) {
    moved.segment<3>(j + 1) = Vec3(1, 2, 3);
    grown[j] = 1;
  }
  EXPECT_LT(moved.dot(bent * moved), 1e-9);
  EXPECT_LT(moved.dot(far * moved), 1e-9);
  EXPECT_LT(grown.dot(bent * grown), 1e-9);  // L_D follows a scale
  // A displacement equal to the place: its mean square is that of the vertices about their mean.
  Vec3 mean = Vec3::Zero();
  double square = 0;
  const auto n = static_cast<double>(of.body.local.vertices.size());
  for (const Vec3& v : of.body.local.vertices) mean += v / n;
  for (const Vec3& v : of.body.local.vertices) square += (v - mean).squaredNorm() / n;
  EXPECT_NEAR(grown.dot(far * grown) / 2, square, 1e-6 * square);
  // As a form in the handles, and of the vertices themselves.
  ScaledHandles any = ScaledHandles::NullaryExpr(
      bent.rows(), [](Eigen::Index i) { return 0.1 * std::sin(static_cast<double>(i)); });
  const std::vector<Vec3> to = of.cells->skin(any).vertices;
  EXPECT_NEAR(surface_energy(of.body.local, to, 1, 0), any.dot(bent * any) / 2, 1e-6 * any.dot(bent * any));
  EXPECT_NEAR(surface_energy(of.body.local, to, 0, 1), any.dot(far * any) / 2, 1e-6 * any.dot(far * any));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
