#include "problem/die.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "domain/test_bodies.hpp"
#include "formulation/quadric.hpp"
#include "problem/differences.hpp"
#include "solve/dual.hpp"
#include "solve/solver.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Body wedge() {
  TriangleMesh mesh = box_mesh({-0.5, -0.5, 0.1}, {0.5, 0.5, 1.1});
  for (Vec3& v : mesh.vertices)
    if (v[2] > 1 && v[0] > 0) v[2] = 0.7;
  return body_of(mesh);
}

std::unique_ptr<Problem> die_of(const Body& body) { return make_die({}, body); }

struct Solved {
  Outcome outcome;
  MassModel mass;
  std::unique_ptr<Formulation> way;
};

Solved solved(const Body& body, const Problem& die, double wall) {
  GridSpec spec;
  spec.resolution = 24;
  const Columns domain = make_columns(body, spec, {wall, Wall::cells});
  Solved s{{}, hollowed(body, domain.interior), make_formulation("quadric", domain, {}, {}, test_device())};
  s.outcome = solve(find_solver("moment", "quadric"), {die, *s.way, s.mass, test_device()}, {});
  return s;
}

TEST(Die, DerivativesMatchCentralDifferences) {
  const Body body = wedge();
  const auto die = die_of(body);
  Random random(63);
  for (int trial = 0; trial < 5; ++trial) {
    // About the solid's centre of mass, with the mass of a hollowed one.
    Moments s = 0.7 * body.solid;
    s.segment<3>(SX) += random_vec(random, -0.03, 0.03);
    expect_derivatives(*die, s, 0.7);
  }
}

TEST(Die, OfACubeStaysSolid) {
  const Body body = body_of(box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  const auto die = die_of(body);
  const Solved s = solved(body, *die, 1.2);
  ASSERT_TRUE(s.outcome.converged()) << s.outcome.message;
  EXPECT_NEAR(s.outcome.moments[S1], body.solid[S1], 1e-9);
  const Verdict verdict = die->verify(s.outcome.moments, 20);
  EXPECT_TRUE(verdict.ok);
  expect_text(verdict, "as fair as its shape allows");
  EXPECT_NEAR(verdict.values.at("least_share"), 1.0 / 6, 1e-9);
}

TEST(Die, GoesAllTheWayWithAThinWallAndKeepsWhatItCan) {
  const Body body = wedge();
  const auto die = die_of(body);
  const Solved s = solved(body, *die, 1.2);
  ASSERT_TRUE(s.outcome.converged()) << s.outcome.message;
  const Verdict verdict = die->verify(s.outcome.moments, 20);
  EXPECT_TRUE(verdict.ok) << verdict.text;
  EXPECT_LT(verdict.values.at("most_share") - verdict.values.at("least_share"),
            0.7 * (die->verify(body.solid, 20).values.at("most_share") -
                   die->verify(body.solid, 20).values.at("least_share")))
      << verdict.text;
}

TEST(Die, NoCentreOfMassThatCanBeReachedIsFairer) {
  const Body body = wedge();
  const auto die = die_of(body);
  const Solved s = solved(body, *die, 6);  // so thick that the fairest is out of reach
  ASSERT_TRUE(s.outcome.converged()) << s.outcome.message;
  EXPECT_FALSE(die->verify(s.outcome.moments, 20).values.at("to_fairest_mm") < 0.1);
  EXPECT_TRUE(die->verify(s.outcome.moments, 20).ok);
  const auto wait = [&](const Moments& m) { return die->verify(m, 20).values.at("excess_wait"); };
  // Whatever a quadric cuts off can be reached, and so can what lies between two of such.
  Random random(64);
  TotalSupport oracle(*s.way->oracle(), s.mass, 0);
  std::vector<Moments> reached;
  for (int trial = 0; trial < 60; ++trial) {
    const Vec3 n = random_vec(random, -1, 1);
    Moments q = Moments::Zero();
    q.segment<3>(SX) = n;
    q[S1] = -n.dot(centre_of_mass(s.outcome.moments)) + uniform(random, -0.1, 0.1);
    reached.push_back(oracle(q, false).moments);
  }
  for (const Moments& a : reached)
    for (const Moments& b : reached)
      EXPECT_GE(wait(0.5 * (a + b)), 0.98 * wait(s.outcome.moments)) << "a hundredth of the way is left out";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
