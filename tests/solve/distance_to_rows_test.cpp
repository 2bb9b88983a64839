#include "solve/distance_to_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "formulation/quadric.hpp"
#include "solve/test_tasks.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// The box of BoxDomain without a shell: all that is there is its interior, of mass `area * height`.
class Distance : public ::testing::Test {
 protected:
  [[nodiscard]] RowDistance to(const LinearConstraints& rows, double relative = 1e-3) const {
    return distance_to_rows(*formulation_->oracle(), mass_, rows, relative);
  }

  const MassModel mass_{Moments::Zero(), 1};
  const double all_ = BoxDomain::area * BoxDomain::height;
  const std::unique_ptr<Formulation> formulation_ = make_quadric(BoxDomain::columns(), {}, {}, test_device());
};

LinearConstraints asked(const std::vector<MomentIndex>& which, const std::vector<double>& values) {
  LinearConstraints rows;
  rows.matrix.setZero(static_cast<Eigen::Index>(which.size()), 10);
  for (std::size_t r = 0; r < which.size(); ++r) {
    rows.matrix(static_cast<Eigen::Index>(r), which[r]) = 1;
    rows.names.emplace_back(moment_names[which[r]]);
  }
  rows.lower = rows.upper =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return rows;
}

TEST_F(Distance, ToMoreMassThanThereIsIsTheMassThatLacks) {
  const RowDistance d = to(asked({S1, SX, SY}, {all_ + 0.25, 0, 0}));
  EXPECT_NEAR(d.attained, 0.25, 1e-9);
  EXPECT_LE(d.proved, 0.25 + 1e-12);
  EXPECT_GE(d.proved, 0.999 * 0.25);
}

TEST_F(Distance, ToAHeightOutOfReachIsBetweenWhatIsProvedAndAttained) {
  // The top half weighs all_/2 at a mean height of base + 3/4 height. Asked for the same mass with a first
  // moment that is greater by e, the nearest point lies in the plane's normal (mass, height) only if more
  // mass helps: distance < e, and not much less.
  const double e = 0.02, half = all_ / 2, z = BoxDomain::base + 0.75 * BoxDomain::height;
  const RowDistance d = to(asked({S1, SZ}, {half, half * z + e}), 1e-6);
  EXPECT_LE(d.proved, d.attained);
  EXPECT_GE(d.proved, (1 - 1e-6) * d.attained);
  EXPECT_LT(d.attained, e);
  // The support line there has the slope of the height of the cut, base + height / 2: its distance from the
  // point asked for is e / sqrt(1 + slope^2), and the boundary is strictly beyond it.
  const double slope = BoxDomain::base + 0.5 * BoxDomain::height;
  EXPECT_GE(d.attained, e / std::sqrt(1 + slope * slope));
}

TEST_F(Distance, IsNoneWhereRowsCanBeMetInsideTheirRange) {
  LinearConstraints rows = asked({S1, SX}, {0, 0});
  rows.lower = Eigen::Vector2d(0.3 * all_, -0.01);
  rows.upper = Eigen::Vector2d(0.4 * all_, 0.01);
  const RowDistance d = to(rows);
  EXPECT_LE(d.attained, 1e-7);
  EXPECT_LE(d.proved, d.attained);
}

TEST_F(Distance, OfRowsWithARangeIsToItsNearerEnd) {
  LinearConstraints rows = asked({S1}, {0});
  rows.lower[0] = all_ + 0.125;
  rows.upper[0] = all_ + 2;
  EXPECT_NEAR(to(rows).attained, 0.125, 1e-9);
  rows.lower[0] = -2;
  rows.upper[0] = -0.5;
  EXPECT_NEAR(to(rows).attained, 0.5, 1e-9);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
