#include "problem/balance.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "domain/test_bodies.hpp"
#include "problem/differences.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double round_off = 64 * 0x1p-53;  // numbers of order one, a handful of roundings each

TEST(Balance, DerivativesMatchCentralDifferences) {
  Random random(91);
  const Balance balance({0.1, 0.2, 0.3}, Vec3(1, 2, 3));
  // Linear: any step will do, and only rounding is left.
  for (int trial = 0; trial < 5; ++trial) expect_derivatives(balance, random_solid(random), 1);
}

TEST(Balance, ValueIsMinusTheMass) {
  EXPECT_EQ(Balance({0, 0, 0}, std::nullopt).value(box_moments({1, 2, 3}, {0.5, 0.5, 2})), -0.5);
}

TEST(Balance, AtAPointMissesTheFirstMomentAboutIt) {
  const Vec3 point(0.3, -0.2, 0.5);
  const Balance balance(point, std::nullopt);
  EXPECT_EQ(balance.constraints().matrix.rows(), 3);
  EXPECT_NEAR(violation(balance, box_moments(point, {1, 2, 3})), 0, 6 * round_off);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(violation(balance, box_moments(point - 0.1 * Vec3::Unit(axis), {1, 2, 1})), 0.2, round_off);
}

TEST(Balance, OnALineIsFreeAlongItAndIsMissedByTheDistanceAcross) {
  Random random(92);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 point = random_vec(random, -1, 1), direction = random_vec(random, -2, 2);
    const Balance balance(point, direction);
    const LinearConstraints& c = balance.constraints();
    ASSERT_EQ(c.matrix.rows(), 2);
    const Vec3 on = point + uniform(random, -2, 2) * direction;
    EXPECT_NEAR(violation(balance, box_moments(on, {1, 1, 1})), 0, 8 * round_off);
    // The two rows are at right angles, so their norm is the distance from the line.
    const Vec3 across = direction.cross(random_vec(random, -1, 1)).normalized();
    const Eigen::Vector2d miss = c.matrix * box_moments(on + 0.3 * across, {1, 1, 1});
    EXPECT_NEAR(miss.norm(), 0.3, 8 * round_off);
  }
}

TEST(BalanceVerdict, OfAPointCountsEveryDirection) {
  const Balance balance({0, 0, 0.5}, std::nullopt);
  const Verdict good = balance.verify(box_moments({0.0005, 0, 0.5005}, {1, 1, 0.75}), 50);
  EXPECT_TRUE(good.ok);
  EXPECT_NEAR(good.values.at("offset"), 0.0005 * std::sqrt(2), round_off);
  EXPECT_NEAR(good.values.at("offset_mm"), 0.025 * std::sqrt(2), 50 * round_off);
  EXPECT_NEAR(good.values.at("mass_share"), 0.75, round_off);
  EXPECT_NEAR(good.values.at("objective"), -0.75, round_off);
  expect_text(good,
              "balances: centre of mass 0.035 mm (7.1e-04 L) off the point, with 75.0 % of the material");
  const Verdict off = balance.verify(box_moments({0, 0, 0.502}, {1, 1, 0.75}), 50);
  EXPECT_FALSE(off.ok);
  expect_text(off, "does not balance: centre of mass 0.100 mm (2.0e-03 L) off the point");
}

TEST(BalanceVerdict, OfALineForgivesWhatLiesAlongIt) {
  const Balance balance({0, 0, 0.5}, Vec3(0, 0, -4));
  EXPECT_TRUE(balance.verify(box_moments({0, 0.0009, 3}, {1, 1, 0.75}), 50).ok);
  const Verdict off = balance.verify(box_moments({0.0008, 0.0009, 3}, {1, 1, 0.75}), 50);
  EXPECT_FALSE(off.ok);
  expect_text(off, "off the line");
  EXPECT_NEAR(off.values.at("offset"), std::hypot(0.0008, 0.0009), round_off);
}

/// A body whose frame differs from its model's: turned, moved and 20 times as large.
Body turned_body() {
  Body body = body_of(box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  body.frame = {axis_to_z({1, 0, 0}), {3, 4, 5}, 20};
  return body;
}

TEST(MakeBalance, TakesPointAndLineInTheModelsCoordinates) {
  const Body body = turned_body();
  const Vec3 at(0.1, -0.2, 0.4), to(0.3, 0.1, 0.9);
  const auto text = [](const Vec3& v) { return fmt::format("{},{},{}", v[0], v[1], v[2]); };
  const Vec3 p = body.frame.to_model(at), q = body.frame.to_model(to);
  const auto point = make_problem("balance", {{"point", text(p)}}, body);
  EXPECT_EQ(point->name(), "balance");
  EXPECT_EQ(point->traits().filling, Filling::either_end);
  EXPECT_EQ(point->constraints().matrix.rows(), 3);
  EXPECT_NEAR(violation(*point, box_moments(at, {1, 1, 1})), 0, round_off);
  const auto line = make_problem("balance", {{"point", text(p)}, {"line", text(q - p)}}, body);
  EXPECT_EQ(line->constraints().matrix.rows(), 2);
  for (const double t : {0.0, 1.0, -3.0})
    EXPECT_NEAR(violation(*line, box_moments(at + t * (to - at), {1, 1, 1})), 0, 4 * round_off);
  EXPECT_GT(violation(*line, box_moments(at + Vec3(0.1, 0, 0), {1, 1, 1})), 0.01);
}

TEST(MakeBalance, RefusesUnfitSettings) {
  const Body body = turned_body();
  expect_refused("balance", {}, body, "balance needs to know where; expected --set problem.point=x,y,z");
  expect_refused("balance", {{"line", "0,0,1"}}, body, "needs to know where");
  expect_refused("balance", {{"point", "1,2"}}, body, "problem.point = 1,2; expected");
  expect_refused("balance", {{"point", "1,2,x"}}, body, "problem.point = 1,2,x; expected");
  expect_refused("balance", {{"point", "1,2,3"}, {"line", "0,0,0"}}, body, "problem.line = 0,0,0; expected");
  expect_refused("balance", {{"point", "1,2,3"}, {"lime", "0,0,1"}}, body,
                 "problem.lime = 0,0,1; balance has no setting of that name (did you mean line?)");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
