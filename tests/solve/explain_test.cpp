#include "solve/explain.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "problem/float.hpp"
#include "solve/rows.hpp"
#include "solve/ways.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double area = BoxDomain::area, bottom = BoxDomain::base, whole = area * BoxDomain::height;
const Moments mass_form = Moments::Unit(S1), height_form = Moments::Unit(SZ), x_form = Moments::Unit(SX);

class Explain : public testing::TestWithParam<Way> {
 protected:
  static std::string of(const Problem& problem, const MassModel& mass = {},
                        const std::optional<BodyUnits>& units = {}) {
    const auto f =
        make_formulation(GetParam().formulation, BoxDomain::columns(), problem.traits(), {}, test_device());
    const Task task{problem, *f, mass, test_device()};
    return explain_infeasible(default_solver(GetParam().formulation), task, options_of(GetParam()), units);
  }
};

// Three digits are printed; the solvers are good to six here, so amounts are chosen away from a half.

TEST_P(Explain, NamesTheOneConstraintThatIsOutOfReach) {
  RowsProblem rows;
  rows.add("balance", x_form, 0, 0).add("mass", mass_form, 1.5 * whole, 1.5 * whole);
  rows.add("height", height_form, -RowsProblem::free, 10);
  EXPECT_EQ(of(rows), fmt::format("mass is missed by {:.3g} (body units)", 0.5 * whole));
}

TEST_P(Explain, SaysGramsAndMillimetresWhereABodyUnitIsKnown) {
  const BodyUnits units{20, 50};
  RowsProblem heavy;
  heavy.add("mass", mass_form, whole + 0.11, RowsProblem::free);
  EXPECT_EQ(of(heavy, {}, units), "mass is missed by 5.5 g");
  // All solid is the highest there is: its first moment misses 0.3, so its centre of mass 0.3 / whole.
  const double highest = area * ((bottom + 1) * (bottom + 1) - bottom * bottom) / 2;
  RowsProblem high;
  high.add("height", height_form, highest + 0.3, RowsProblem::free);
  EXPECT_EQ(of(high, {}, units), fmt::format("height is missed by {:.3g} mm", 20 * 0.3 / whole));
}

TEST_P(Explain, NamesEachOfSeveralThatAreOutOfReach) {
  // The most that leans to the right: columns at 1/16, 3/16 and 5/16, 4 x 8 cells each.
  const double most = 4 * 8 * std::pow(BoxDomain::h, 3) * 9 / 16.0;
  RowsProblem rows;
  rows.add("mass", mass_form, whole + 0.11, RowsProblem::free)
      .add("lean", x_form, most + 0.1, RowsProblem::free);
  EXPECT_EQ(of(rows), "mass is missed by 0.11; lean is missed by 0.1 (body units)");
}

TEST_P(Explain, NamesTheWorstFirstAndWhatIsMissedByMuchLess) {
  // All solid is the best for both, and misses one by 0.11, the other by 0.3.
  const double highest = area * ((bottom + 1) * (bottom + 1) - bottom * bottom) / 2;
  RowsProblem rows;
  rows.add("mass", mass_form, whole + 0.11, RowsProblem::free);
  rows.add("moment", height_form, highest + 0.3, RowsProblem::free);
  EXPECT_EQ(of(rows), "moment is missed by 0.3; mass is missed by 0.11 (body units)");
}

TEST_P(Explain, TellsPerpendicularRowsOfOneNameAsOneDistance) {
  const char* name = "the centre of mass stays {} beside the axis";
  RowsProblem rows;
  // The most that leans to the right, as above, and the most mass: 3, 4, 5.
  const double most = 4 * 8 * std::pow(BoxDomain::h, 3) * 9 / 16.0;
  rows.add(name, x_form, most + 0.3, RowsProblem::free).add(name, mass_form, whole + 0.4, RowsProblem::free);
  EXPECT_EQ(of(rows), "the centre of mass stays 0.5 beside the axis (body units)");
}

TEST_P(Explain, NamesConstraintsThatCannotBeMetTogether) {
  // Much material, yet a small first moment: either is possible.
  const double mass = 0.9 * whole, moment = 0.3 * area * ((bottom + 1) * (bottom + 1) - bottom * bottom) / 2;
  RowsProblem rows;
  rows.add("mass", mass_form, mass, RowsProblem::free).add("moment", height_form, -RowsProblem::free, moment);
  rows.add("balance", x_form, 0, 0);
  // Filled from below up to T, both are missed by t: a (T - b) = mass - t, a (T^2 - b^2) / 2 = moment + t.
  const double u = (mass + moment) / area + bottom + bottom * bottom / 2, height = -1 + std::sqrt(1 + 2 * u);
  double t = mass - area * (height - bottom);
  if (GetParam().formulation == "voxel") {  // layer by layer, the last in part
    double s1 = 0, sz = 0;
    for (int k = 0; k < BoxDomain::layers; ++k) {
      const double m = area * BoxDomain::h, arm = bottom + (k + 0.5) * BoxDomain::h;
      const double share = std::clamp((mass + moment - s1 - sz) / (m * (1 + arm)), 0.0, 1.0);
      s1 += share * m;
      sz += share * m * arm;
    }
    t = mass - s1;
  }
  EXPECT_EQ(of(rows),
            fmt::format("not all that is asked can be met together; in the best compromise mass is missed "
                        "by {0:.3g}; moment is missed by {0:.3g} (body units)",
                        t));
}

TEST_P(Explain, SaysSoWhenTheConstraintsCanBeMet) {
  RowsProblem rows;
  rows.add("mass", mass_form, whole / 2, whole / 2).add("balance", x_form, 0, 0);
  EXPECT_EQ(of(rows), "the constraints alone can be met: the solver stopped at a local infeasibility");
}

TEST_P(Explain, AFloatThatIsTooHeavySaysByHowMuch) {
  const MassModel mass{0.3 * box_moments({0, 0, 0.5}, Vec3::Ones()), 1};
  EXPECT_EQ(of(Float({{0.5, 1, Vec3(0, 0, 0.3), 1, 1}, 0.18, 1, 1}), mass),
            "the mass stays 0.12 away from that of the displaced water (body units)");
}

INSTANTIATE_TEST_SUITE_P(Ways, Explain, testing::ValuesIn(ways()),
                         [](const auto& p) { return name_of(p.param); });

}  // namespace THIS_FILE
}  // namespace kreisel::core
