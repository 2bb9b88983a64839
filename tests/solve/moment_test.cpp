// moment_test.cpp - what the moment solver promises beyond the known optima of optima_test.cpp.
#include "solve/moment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "domain/test_bodies.hpp"
#include "error.hpp"
#include "formulation/quadric.hpp"
#include "problem/balance.hpp"
#include "problem/spin.hpp"
#include "problem/stand.hpp"
#include "solve/certificate.hpp"
#include "solve/dual.hpp"
#include "solve/test_tasks.hpp"

namespace kreisel::core {
namespace THIS_FILE {

struct Solved {
  Outcome outcome;
  MassModel mass;
};

Solved solve_on(const Columns& domain, const Problem& problem, const MassModel& mass,
                const std::string& formulation = "quadric") {
  const auto way = make_formulation(formulation, domain, problem.traits(), {}, test_device());
  const Task task{problem, *way, mass, test_device()};
  return {solve(default_solver(formulation), task, {}), mass};
}

/// A box about (0.05, 0.02, 0.6), off its axis, so that spinning takes work.
Body leaning_box() { return body_of(box_mesh({-0.6, -0.45, 0.1}, {0.7, 0.49, 0.9})); }

Columns columns_of(const Body& body, int resolution) {
  GridSpec spec;
  spec.resolution = resolution;
  return make_columns(body, spec, {1.2, Wall::cells});
}

TEST(MomentSolver, IsNoWorseThanRayRepAndMeetsTheConstraintsToRoundOff) {
  const Body body = leaning_box();
  const Columns domain = columns_of(body, 30);
  const MassModel mass = hollowed(body, domain.interior);
  const Spin problem({});
  const Outcome quadric = solve_on(domain, problem, mass).outcome;
  const Outcome rays = solve_on(domain, problem, mass, "rayrep").outcome;
  ASSERT_EQ(quadric.termination, Termination::optimal) << quadric.message;
  EXPECT_LE(quadric.violation, 1e-12);
  EXPECT_LE(quadric.objective, rays.objective + 1e-6);
  EXPECT_LT(quadric.objective, problem.value(body.solid) - 0.05) << "nothing gained, nothing tested";
  // Newton's method: a handful of passes, not dozens.
  EXPECT_LE(quadric.evaluations.hessian + quadric.evaluations.objective, 60);
}

TEST(MomentSolver, PassesOverAFineGridAFewTimesOnly) {
  const Body body = leaning_box();
  const Columns domain = columns_of(body, 144);  // more than 8000 rays: a coarser level on the device
  const MassModel mass = hollowed(body, domain.interior);
  const Spin problem({});
  const auto way = make_formulation("quadric", domain, {}, {}, test_device());
  ASSERT_GE(way->oracle()->levels(), 3);
  const Task task{problem, *way, mass, test_device()};
  SolverOptions fine_only;
  fine_only.own = MomentSettings{.tolerance = {}, .levels = 1, .seed = {}};
  const Outcome cold = solve_with_moments(task, fine_only), warm = solve_with_moments(task, {});
  ASSERT_EQ(cold.termination, Termination::optimal) << cold.message;
  ASSERT_EQ(warm.termination, Termination::optimal) << warm.message;
  EXPECT_NEAR(cold.objective, warm.objective, 1e-12);
  // Some five models of six passes and Newton's method; then its last four or five steps alone.
  const int passes = cold.evaluations.objective + cold.evaluations.hessian;
  EXPECT_LE(passes, 45);
  EXPECT_NE(cold.message.find(std::to_string(passes) + " passes at full resolution"), std::string::npos)
      << cold.message;
  int few = 0;
  for (int n = 1; n <= 8; ++n)
    few += warm.message.find(", " + std::to_string(n) + " passes at full resolution") != std::string::npos;
  EXPECT_EQ(few, 1) << warm.message;
}

TEST(MomentSolver, EndsWhereTheQuadricIsThatOfItsMultipliers) {
  const Body body = leaning_box();
  const Columns domain = columns_of(body, 24);
  const MassModel mass = hollowed(body, domain.interior);
  for (const double lambda : {0.0, 1.0, 100.0, 1e6}) {
    SpinOptions options;
    options.lambda = lambda;
    const Spin problem(options);
    const Outcome outcome = solve_on(domain, problem, mass).outcome;
    ASSERT_EQ(outcome.termination, Termination::optimal) << outcome.message << " with " << lambda;
    Moments q = problem.gradient(outcome.moments);
    for (Eigen::Index r = 0; r < 4; ++r)
      q += outcome.multipliers[static_cast<std::size_t>(r)] * problem.constraints().matrix.row(r).transpose();
    const double scale = q.cwiseAbs().maxCoeff();
    EXPECT_LE((q / scale - Moments(outcome.x.data())).cwiseAbs().maxCoeff(), 1e-9) << lambda;
    // f is homogeneous of degree zero in s and the constraints are homogeneous: q . s = 0. [docs/quadric.md]
    EXPECT_LE(std::abs(q.dot(outcome.moments)), 1e-12 * scale) << lambda;
  }
}

TEST(MomentSolver, StandsOnAPlaneThroughTheCentreOfMass) {
  const Body body = leaning_box();
  const Columns domain = columns_of(body, 24);
  const MassModel mass = hollowed(body, domain.interior);
  const Base base{hull_of({{-0.5, -0.4}, {0.5, -0.4}, {0.5, 0.4}, {-0.5, 0.4}}), 0.1, 0.8};
  const Outcome outcome = solve_on(domain, Stand(base, std::nullopt), mass).outcome;
  ASSERT_EQ(outcome.termination, Termination::optimal) << outcome.message;
  const Moments q(outcome.x.data());
  EXPECT_EQ(q.tail<6>().cwiseAbs().maxCoeff(), 0);
  const Eigen::Vector3d c = centre_of_mass(outcome.moments);
  EXPECT_NEAR(q[S1] + q.segment<3>(SX).dot(c), 0, 1e-12);
}

TEST(MomentSolver, ProvesWhatCannotBeMet) {
  // The axis misses the box.
  const Body body = body_of(box_mesh({0.2, -0.4, 0.1}, {1.4, 0.5, 0.9}));
  const Columns domain = columns_of(body, 24);
  const MassModel mass = hollowed(body, domain.interior);
  const Spin problem({});
  const Outcome outcome = solve_on(domain, problem, mass).outcome;
  ASSERT_EQ(outcome.termination, Termination::infeasible) << outcome.message;
  // The separating quadric is positive for every filling: for all, for nothing, and for the worst.
  const auto quadric = make_formulation("quadric", domain, {}, {}, test_device());
  TotalSupport total(*quadric->oracle(), mass, 0);
  const Moments q(outcome.x.data());
  EXPECT_GT(total(q, false).value, 1e-6);
  EXPECT_GT(q.dot(mass.fixed), 1e-6);
  EXPECT_GT(q.dot(mass.total(domain.interior)), 1e-6);
  // It is made of the constraints' forms alone.
  const auto& forms = problem.constraints().matrix;
  EXPECT_LE((q - forms.transpose() * (forms * q)).norm(), 1e-14);
}

TEST(MomentSolver, TakesABodyOfRevolutionAboutItsAxis) {
  // All four constraints hold by symmetry, whatever a symmetric quadric takes away.
  const Body body = body_of(box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  const Columns domain = columns_of(body, 20);
  const MassModel mass = hollowed(body, domain.interior);
  const Outcome outcome = solve_on(domain, Spin({}), mass).outcome;
  ASSERT_EQ(outcome.termination, Termination::optimal) << outcome.message;
  const Moments q(outcome.x.data());
  EXPECT_LE(std::abs(q[SX]) + std::abs(q[SY]) + std::abs(q[SXZ]) + std::abs(q[SYZ]), 1e-9);
  EXPECT_NEAR(q[SXX], q[SYY], 1e-9);
}

TEST(MomentSolver, FillsAllWhenThatIsBest) {
  // A flat slab spins best with all of its mass.
  const Body body = body_of(box_mesh({-1.2, -1.2, 0}, {1.2, 1.2, 0.175}));
  const Columns domain = columns_of(body, 40);
  const MassModel mass = hollowed(body, domain.interior);
  const Outcome outcome = solve_on(domain, Spin({}), mass).outcome;
  ASSERT_EQ(outcome.termination, Termination::optimal) << outcome.message;
  EXPECT_LE(outcome.objective, Spin({}).value(mass.total(domain.interior)) + 1e-12);
}

TEST(MomentSolver, SaysOfOneRayThatItCannotBalance) {
  Columns domain = columns_of(leaning_box(), 24);
  domain.intervals.resize(1);
  const Interval& run = domain.intervals[0];
  domain.interior = box_moments({domain.grid.centre(0, run.ix), domain.grid.centre(1, run.iy),
                                 (domain.grid.face(2, run.k0) + domain.grid.face(2, run.k1)) / 2},
                                {domain.grid.h, domain.grid.h, (run.k1 - run.k0) * domain.grid.h});
  const MassModel mass = hollowed(leaning_box(), domain.interior);
  EXPECT_EQ(solve_on(domain, Spin({}), mass).outcome.termination, Termination::infeasible);
}

TEST(MomentSolver, LeavesABodyWithoutInteriorAsItIs) {
  // Symmetric, it meets the constraints as it is; leaning, nothing can be done about them.
  for (const bool leans : {false, true}) {
    const Body body = leans ? leaning_box() : body_of(box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 0.4}));
    Columns domain = columns_of(body, 20);
    domain.intervals.clear();
    domain.interior.setZero();
    const MassModel mass = hollowed(body, domain.interior);
    const Outcome outcome = solve_on(domain, Spin({}), mass).outcome;
    EXPECT_EQ(outcome.termination, leans ? Termination::infeasible : Termination::optimal) << outcome.message;
    EXPECT_LE((outcome.moments - body.solid).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(MomentSolver, TakesAThinPlate) {
  // A few layers of cells are left between the walls.
  const Body body = body_of(box_mesh({-1.0, -0.9, 0}, {1.04, 0.94, 0.23}));
  const Columns domain = columns_of(body, 40);
  int thickest = 0;
  for (const Interval& run : domain.intervals) thickest = std::max(thickest, run.k1 - run.k0);
  ASSERT_LE(thickest, 3);
  const MassModel mass = hollowed(body, domain.interior);
  const Outcome outcome = solve_on(domain, Spin({}), mass).outcome;
  ASSERT_EQ(outcome.termination, Termination::optimal) << outcome.message;
  EXPECT_LE(outcome.violation, 1e-12);
}

TEST(MomentSolver, TakesSeveralPieces) {
  // Two boxes side by side on either side of the axis, one larger: material has to leave that one.
  TriangleMesh both = box_mesh({-1.0, -0.3, 0.1}, {-0.3, 0.35, 0.8});
  const TriangleMesh other = box_mesh({0.3, -0.35, 0.1}, {1.1, 0.3, 0.9});
  const auto offset = static_cast<std::uint32_t>(both.vertices.size());
  both.vertices.insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles)
    both.triangles.push_back({a + offset, b + offset, c + offset});
  const Body body = body_of(both);
  const Columns domain = columns_of(body, 40);
  const MassModel mass = hollowed(body, domain.interior);
  const Outcome outcome = solve_on(domain, Spin({}), mass).outcome;
  ASSERT_EQ(outcome.termination, Termination::optimal) << outcome.message;
  EXPECT_LE(outcome.violation, 1e-12);
  EXPECT_LE(outcome.objective, solve_on(domain, Spin({}), mass, "rayrep").outcome.objective + 1e-6);
}

TEST(MomentSolver, SaysWhenTheConstraintsCanBarelyBeMet) {
  // The centre of mass of the box at the greatest height that a void below a plane lifts it to, less a hair:
  // the multiplier grows without limit towards it.
  const Body body = body_of(box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  const Columns domain = columns_of(body, 20);
  const MassModel mass = hollowed(body, domain.interior);
  const auto quadric = make_formulation("quadric", domain, {}, {}, test_device());
  TotalSupport total(*quadric->oracle(), mass, 0);
  // max sz / s1: the fixed point of filling everything above it.
  double highest = 0.5;
  for (int i = 0; i < 100; ++i) {
    const Moments s = total(highest * Moments::Unit(S1) - Moments::Unit(SZ), false).moments;
    highest = s[SZ] / s[S1];
  }
  const auto at = [&](double z) { return solve_on(domain, Balance({0, 0, z}, Vec3(1, 0, 0)), mass).outcome; };
  const Outcome barely = at(highest - 1e-10), easily = at(highest - 1e-2);
  ASSERT_EQ(easily.termination, Termination::optimal) << easily.message;
  EXPECT_EQ(easily.message.find("barely"), std::string::npos) << easily.message;
  ASSERT_EQ(barely.termination, Termination::optimal) << barely.message;
  EXPECT_NE(barely.message.find("the constraints can barely be met"), std::string::npos) << barely.message;
  EXPECT_EQ(at(highest + 1e-6).termination, Termination::infeasible);
}

TEST(MomentSolver, BalancesWhereTheCutIsAlongTheRays) {
  // Beside the middle of a box, the plane is upright and holds a whole layer of columns, of which a part is
  // to be filled; no multipliers say which.
  const Body body = body_of(box_mesh({-0.6, -0.45, 0}, {0.6, 0.45, 0.926}));
  const Columns domain = columns_of(body, 24);
  const MassModel mass = hollowed(body, domain.interior);
  const double middle = centre_of_mass(mass.total(domain.interior))[2];
  for (const Vec3& off :
       {Vec3(0.03, 0, 0), Vec3(0, -0.0217, 0), Vec3(0.02, 0.02, 0), Vec3(0.041, 0.007, 0)}) {
    SCOPED_TRACE(testing::Message() << off.transpose());
    const Balance problem(Vec3(0, 0, middle) + off, std::nullopt);
    const Outcome outcome = solve_on(domain, problem, mass).outcome;
    ASSERT_EQ(outcome.termination, Termination::optimal) << outcome.message;
    // The layer is cut where a millionth of z^2 says, which ten digits are left of.
    EXPECT_LE(outcome.violation, 1e-9);
    const Certificate c = certify(problem, rays_of(domain), mass, test_device(), {});
    EXPECT_LE(outcome.objective - c.bound, 1e-6) << "a millionth of what szz may differ by";
    EXPECT_LE(outcome.evaluations.hessian, 400) << "of hundreds, not thousands";
    EXPECT_GT(outcome.objective, -0.999) << "nothing removed, nothing tested";
  }
}

TEST(MomentSolver, RefusesWhatItDoesNotKnow) {
  const Columns& domain = BoxDomain::columns();
  const LowestMass problem(0.3);
  const auto way = make_formulation("quadric", domain, {}, {}, test_device());
  const MassModel mass;
  const Task task{problem, *way, mass, test_device()};
  for (const auto& [name, value] : {std::pair{"tolerance", "0"}, {"levels", "1.5"}, {"max_iter", "3"}}) {
    EXPECT_THROW((void)solvers().find("moment").read({{name, value}}), InputError) << name;
  }
  EXPECT_THROW((void)make_formulation("quadric", domain, {}, {{"bounds", "ordered"}}, test_device()),
               InputError);
}

TEST(MomentSolver, FillsABoxFromBelow) {
  const LowestMass problem(0.3);
  const auto way = make_formulation("quadric", BoxDomain::columns(), {}, {}, test_device());
  const MassModel mass;
  const Outcome outcome = solve(default_solver("quadric"), {problem, *way, mass, test_device()}, {});
  ASSERT_EQ(outcome.termination, Termination::optimal) << outcome.message;
  EXPECT_NEAR(outcome.objective, BoxDomain::lowest_rays(0.3 / BoxDomain::area), 1e-14);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
