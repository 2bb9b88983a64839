#include "problem/turned.hpp"

#include <gtest/gtest.h>

#include "problem/differences.hpp"
#include "problem/spin.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A product with a 10 x 10 matrix of numbers up to ten, and what made it: a few hundred roundings at most.
constexpr double round_off = 1024 * 0x1p-53;

struct Turn {
  Eigen::Matrix3d R;
  Vec3 t;
};

Turn random_turn(Random& random) {
  const Eigen::Matrix3d R = random_rotation(random);
  return {R, random_vec(random, -0.5, 0.5)};
}

Moments of_point(double mass, const Vec3& p) {
  Moments s;
  s << 1, p[0], p[1], p[2], p[0] * p[1], p[1] * p[2], p[0] * p[2], p[0] * p[0], p[1] * p[1], p[2] * p[2];
  return mass * s;
}

TEST(MomentMap, TakesPointMassesToWhereTheyAreMoved) {
  Random random(21);
  for (int trial = 0; trial < 10; ++trial) {
    const Turn turn = random_turn(random);
    Moments before = Moments::Zero(), after = Moments::Zero();
    for (int point = 0; point < 12; ++point) {
      const Vec3 p = random_vec(random, -1, 1);
      const double mass = uniform(random, 0.5, 1);
      before += of_point(mass, p);
      after += of_point(mass, turn.R * p + turn.t);
    }
    const Moments mapped = moment_map(turn.R, turn.t) * before;
    for (int k = 0; k < 10; ++k) EXPECT_NEAR(mapped[k], after[k], 100 * round_off) << moment_names[k];
  }
}

TEST(MomentMap, IsTransformedAsAMatrix) {
  Random random(22);
  for (int trial = 0; trial < 10; ++trial) {
    const Turn turn = random_turn(random);
    const Moments s = random_solid(random);
    const Moments difference = moment_map(turn.R, turn.t) * s - transformed(s, turn.R, turn.t);
    EXPECT_LE(difference.cwiseAbs().maxCoeff(), round_off);
  }
}

TEST(Turned, DerivativesMatchCentralDifferences) {
  Random random(23);
  for (int trial = 0; trial < 5; ++trial) {
    const Turn turn = random_turn(random);
    // s lies in the domain's frame, T s where a spinning body has its contact point.
    const Moments in_place = random_solid(random);
    const Moments s = transformed(in_place, turn.R.transpose(), -turn.R.transpose() * turn.t);
    const Turned problem(std::make_unique<Spin>(SpinOptions{0.5, 1}), turn.R, turn.t);
    EXPECT_NEAR(problem.value(s), Spin({0.5, 1}).value(in_place), 1e3 * round_off);
    // Izz, the smallest denominator, is 0.1 to 0.2; several entries of s make it, each with a factor up to
    // one.
    expect_derivatives(problem, s, 0.03);
  }
}

TEST(Turned, IsMissedByAndJudgedOnTheMomentsInItsOwnFrame) {
  Random random(24);
  const Turn turn = random_turn(random);
  const Moments in_place = random_solid(random);
  const Moments s = transformed(in_place, turn.R.transpose(), -turn.R.transpose() * turn.t);
  const Turned problem(std::make_unique<Spin>(SpinOptions{}), turn.R, turn.t);
  const Spin spin(SpinOptions{});
  ASSERT_GT(violation(spin, in_place), 1e-3);
  EXPECT_NEAR(violation(problem, s), violation(spin, in_place), round_off);
  const Verdict got = problem.verify(s, 40), want = spin.verify(in_place, 40);
  EXPECT_EQ(got.text, want.text);
  EXPECT_NEAR(got.values.at("off_axis_mm"), want.values.at("off_axis_mm"), 100 * round_off);
}

/// Linear, and followed by a problem whose value tells the moments it was made from.
class Sequence final : public Problem {
 public:
  explicit Sequence(double offset, bool last) : offset_(offset), last_(last) {
    constraints_.matrix.resize(0, 10);
  }
  [[nodiscard]] std::string_view name() const override { return "sequence"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::linear; }
  [[nodiscard]] Traits traits() const override { return {Filling::from_below}; }
  [[nodiscard]] double value(const Moments& s) const override { return s[SX] + offset_; }
  [[nodiscard]] Moments gradient(const Moments&) const override { return Moments::Unit(SX); }
  [[nodiscard]] Matrix10 hessian(const Moments&) const override { return Matrix10::Zero(); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] std::unique_ptr<Problem> next(const Moments& s) const override {
    if (last_) return nullptr;
    return std::make_unique<Sequence>(s[SZ], true);
  }
  [[nodiscard]] Verdict verify(const Moments&, double) const override { return {}; }

 private:
  double offset_;
  bool last_;
  LinearConstraints constraints_;
};

TEST(Turned, PassesTheNextProblemOn) {
  Random random(25);
  const Turn turn = random_turn(random);
  const Moments s = random_solid(random), there = transformed(s, turn.R, turn.t);
  const Turned first(std::make_unique<Sequence>(0, false), turn.R, turn.t);
  EXPECT_EQ(first.traits().filling, Filling::either_end) << "from below in its own frame only";
  const std::unique_ptr<Problem> second = first.next(s);
  ASSERT_NE(second, nullptr);
  EXPECT_NEAR(second->value(s), there[SX] + there[SZ], round_off);
  EXPECT_EQ(second->next(s), nullptr);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
