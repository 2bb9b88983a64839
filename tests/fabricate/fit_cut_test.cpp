#include "fabricate/fit_cut.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "domain/test_bodies.hpp"
#include "mesh/query/distance.hpp"
#include "mesh/solid/self_intersections.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A box of 1 x 1 x 1 on z = 0, void above a plane that leans.
struct CutBox {
  CutBox() {
    q[S1] = -0.45;
    q[SX] = 0.1;
    q[SZ] = 1;
    inside = inside_of(body, mesher, q);
  }

  [[nodiscard]] CutShift shift() const {
    return {body, inside, q, [this](const Vec3& p) { return mesher.deep(p); }};
  }

  Body body = body_of(box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  CavityMesher mesher{body, 0.1, 0.04};
  Moments q = Moments::Zero();
  Inside inside;
};

/// What the moments should have: these rows at these values.
LinearConstraints rows(const std::vector<std::pair<MomentIndex, double>>& wanted) {
  LinearConstraints c;
  const auto n = static_cast<Eigen::Index>(wanted.size());
  c.matrix.setZero(n, 10);
  c.lower.resize(n);
  for (Eigen::Index r = 0; r < n; ++r) {
    c.matrix(r, wanted[static_cast<std::size_t>(r)].first) = 1;
    c.lower[r] = wanted[static_cast<std::size_t>(r)].second;
    c.names.emplace_back("row");
  }
  c.upper = c.lower;
  return c;
}

TEST(CutShift, MeetsRowsToRoundOffInAFewSteps) {
  const CutBox box;
  const Moments before = moments_of(box.body, box.inside);
  const LinearConstraints wanted =
      rows({{S1, before[S1] + 1e-3}, {SX, before[SX] - 2e-4}, {SY, before[SY] + 1e-4}});
  CutShift shift = box.shift();
  Moments now = before;
  for (int step = 0; step < 12; ++step) {
    if ((wanted.matrix * now - wanted.lower).lpNorm<Eigen::Infinity>() < 1e-12) break;
    ASSERT_TRUE(shift.toward(wanted, now));
    now = moments_of(box.body, shift.shifted());
  }
  EXPECT_LT((wanted.matrix * now - wanted.lower).lpNorm<Eigen::Infinity>(), 1e-12);
  // A thousandth of the volume over a cut of 0.76 square: some 0.0017, and several times that for leaning.
  EXPECT_LT(shift.most(), 0.012);
  EXPECT_GT(shift.most(), 1e-3 / 0.6);
  EXPECT_TRUE(self_intersections(shift.shifted().voids).empty());
}

TEST(CutShift, MovesOnlyTheCutAndKeepsTheWall) {
  const CutBox box;
  CutShift shift = box.shift();
  const Moments before = moments_of(box.body, box.inside);
  ASSERT_TRUE(shift.toward(rows({{S1, before[S1] - 2e-3}}), before));
  const Inside moved = shift.shifted();
  const SurfaceDistance skin(box.body.local);
  std::size_t changed = 0;
  for (std::size_t v = 0; v < moved.voids.vertices.size(); ++v) {
    const Vec3 &was = box.inside.voids.vertices[v], &is = moved.voids.vertices[v];
    if (is == was) continue;
    ++changed;
    EXPECT_NEAR(box.q[S1] + box.q.segment<3>(SX).dot(was), 0, 1e-9) << "it was on the plane";
    EXPECT_LT(box.q[S1] + box.q.segment<3>(SX).dot(is), 0) << "less material, a lower cut";
    EXPECT_GE(skin(is, 1), 0.1);
  }
  EXPECT_GT(changed, 100u);
}

TEST(CutShift, AsksForNothingWhereRowsAreMetAndSaysWhereNothingCanMove) {
  const CutBox box;
  const Moments now = moments_of(box.body, box.inside);
  CutShift shift = box.shift();
  LinearConstraints room = rows({{S1, now[S1] - 0.1}});
  room.upper.array() += 0.2;
  EXPECT_FALSE(shift.toward(room, now));
  EXPECT_EQ(shift.most(), 0);
  Inside full;  // nothing is void
  CutShift none(box.body, full, box.q, [](const Vec3&) { return true; });
  EXPECT_FALSE(none.toward(rows({{S1, now[S1] + 1}}), now));
}

TEST(CutShift, ARowOnceMissedIsHeld) {
  const CutBox box;
  Moments now = moments_of(box.body, box.inside);
  LinearConstraints most = rows({{S1, now[S1] - 1e-3}});
  most.lower.setConstant(-std::numeric_limits<double>::infinity());  // no more mass than that
  CutShift shift = box.shift();
  for (int step = 0; step < 6; ++step) {
    (void)shift.toward(most, now);
    now = moments_of(box.body, shift.shifted());
  }
  EXPECT_NEAR(now[S1], most.upper[0], 1e-12) << "at its end, not beyond it";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
