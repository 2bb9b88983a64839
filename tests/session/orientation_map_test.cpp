#include "session/orientation_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "body/test_meshes.hpp"
#include "error.hpp"
#include "mesh/io/write.hpp"
#include "session/pipeline.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

OrientationMap map_of(const MapSpec& spec) {
  Session session;
  return map_orientations(session, spec);
}

class Map : public ::testing::Test {
 protected:
  /// A box about the origin as a file, 24 cells along its longest side, and a wall that turns with it.
  [[nodiscard]] RunConfig box(const Vec3& edges) const {
    const std::filesystem::path file = folder_.path / "box.off";
    write_mesh(file, {box_mesh(-edges / 2, edges / 2)});
    RunConfig config;
    config.body.model = file.string();
    config.grid.resolution = 24;
    config.wall = {2, Wall::millimetres};
    config.formulation = "quadric";
    config.solver = "moment";
    return config;
  }

  const TemporaryFolder folder_;
};

TEST_F(Map, AlongTheDomainsOwnAxisIsThePlainRun) {
  for (const char* problem : {"spin", "float"}) {
    RunConfig config;
    config.body.fineness = 16;
    config.grid.resolution = 32;
    config.formulation = "quadric";
    config.solver = "moment";
    config.problem = problem;
    const bool floats = config.problem == "float";
    if (floats) config.settings["problem.draft"] = "60%";
    const RunResult plain = run(config).result;
    const OrientationMap map =
        map_of({MapRun(config),
                {plain.axis},
                floats ? std::vector<std::string>{"60%"} : std::vector<std::string>{}});
    ASSERT_EQ(map.axes.size(), 1u);
    ASSERT_LE((map.contacts[0] - plain.contact).norm(), 1e-9);
    ASSERT_EQ(plain.outcome.termination, Termination::optimal) << problem;
    const MapAnswer& answer = map.at(0, 0);
    EXPECT_EQ(answer.status, MapAnswer::feasible);
    EXPECT_EQ(answer.miss, 0);
    // A map ends at a residual of 1e-8; multipliers, of order one, say what that is worth.
    EXPECT_NEAR(answer.objective, plain.outcome.objective, 1e-7) << problem;
    EXPECT_EQ(map.count_ok(0), answer.verdict.ok ? 1u : 0u);
    EXPECT_EQ(map.grid.n, plain.grid.n);
    EXPECT_EQ(map.rays, plain.rays);
  }
}

TEST_F(Map, OfACubeIsThatOfACube) {
  RunConfig config = box({40, 40, 40});
  config.domain = "columns";  // alike on all sides; exact rays end at the wall above and below alone
  const OrientationMap map =
      map_of({MapRun(config),
              {Vec3::UnitZ(), -Vec3::UnitZ(), Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitY()},
              {}});
  ASSERT_EQ(map.answers.size(), 6u);
  const double f = map.at(0, 0).objective;
  for (std::size_t a = 0; a < 6; ++a) {
    EXPECT_EQ(map.at(a, 0).status, MapAnswer::feasible) << a;
    EXPECT_TRUE(map.at(a, 0).verdict.ok) << map.at(a, 0).verdict.text;
    EXPECT_LE((map.contacts[a] + 20 * map.axes[a]).norm(),
              1e-4);  // the middle of the face; floats in the file
    // Along z columns are cut where the quadric is; across, in steps of h: h/a = 1/24 of the surface's first
    // order cancels in the sum, of the second (1/24)^2 = 0.2 % is left.
    EXPECT_NEAR(map.at(a, 0).objective, f, 0.005 * f) << a;
  }
  // Upside down the same numbers are summed with other signs.
  for (const std::size_t a : {0u, 2u, 4u})
    EXPECT_NEAR(map.at(a, 0).objective, map.at(a + 1, 0).objective, 1e-7) << a;
}

TEST_F(Map, AgreesWithRunsWhoseGridIsTurned) {
  RunConfig config;
  config.body.fineness = 16;
  config.grid.resolution = 32;
  config.wall = {2, Wall::millimetres};
  config.formulation = "quadric";
  config.solver = "moment";
  const Vec3 near[] = {{0.1, 0, 1}, {0, -0.15, 1}, {0.1, 0.1, -1}};
  const OrientationMap map = map_of({MapRun(config), {near[0], near[1], near[2]}, {}});
  std::size_t compared = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    RunConfig turned = config;
    turned.body.axis = map.axes[a];
    turned.body.contact = map.contacts[a];
    const RunResult plain = run(turned).result;
    ASSERT_EQ(plain.outcome.termination == Termination::optimal, map.at(a, 0).status == MapAnswer::feasible);
    if (map.at(a, 0).status != MapAnswer::feasible) continue;
    ++compared;
    // Two grids differ in which cells of the interior's surface they take: 6 of 32 cells across in volume,
    // half of a cell at random each.
    EXPECT_NEAR(map.at(a, 0).objective, plain.outcome.objective, 0.02 * plain.outcome.objective) << a;
  }
  EXPECT_GE(compared, 2u);
}

TEST_F(Map, SaysWhereNoInteriorWillDoAndByHowMuch) {
  // A little off the face's normal the box stands on a corner, far beside anything that can be its centre.
  const OrientationMap map =
      map_of({MapRun(box({40, 30, 24})), {Vec3::UnitZ(), Vec3(0.06, 0.06, 1), Vec3(0.03, 0.03, 1)}, {}});
  EXPECT_EQ(map.at(0, 0).status, MapAnswer::feasible);
  for (const std::size_t a : {1u, 2u}) {
    const MapAnswer& answer = map.at(a, 0);
    EXPECT_EQ(answer.status, MapAnswer::infeasible);
    EXPECT_FALSE(answer.verdict.ok);
    EXPECT_TRUE(std::isnan(answer.objective));
    // The shell alone, a tenth or more of the mass, is some half a length beside the corner.
    EXPECT_GT(answer.miss, 0.01);
    EXPECT_LT(answer.miss, 1);
  }
  EXPECT_EQ(map.count(0, MapAnswer::infeasible), 2u);
  ASSERT_TRUE(map.best());
  EXPECT_EQ(map.best()->axis, 0u);
}

TEST_F(Map, ThroughTheCentreOfMassRunsOnAPegThatReachesTheGround) {
  MapSpec spec{MapRun(box({40, 30, 24})), {Vec3::UnitZ(), Vec3(0.06, 0.06, 1), Vec3(1, 2, 3)}, {}};
  spec.through = Through::centre;
  const OrientationMap map = map_of(spec);
  for (std::size_t a = 0; a < 3; ++a) {
    const Vec3& n = map.axes[a];
    // The centre is the model's origin; the lowest corner has the signs of -n.
    const double down = n.cwiseAbs().dot(Vec3(20, 15, 12));
    EXPECT_LE((map.contacts[a] + down * n).norm(), 1e-4) << a;
  }
  EXPECT_EQ(map.at(0, 0).status, MapAnswer::feasible);
  EXPECT_EQ(map.at(1, 0).status, MapAnswer::feasible) << "standing on the corner it is not";
}

TEST_F(Map, OfABargeFloatsOnEverySideAsTheBookSays) {
  // 40 x 20 x 12 mm of 0.8 g/cm^3 in water. On a side of height H at draft d, b the lesser side of the
  // waterplane: KM = d/2 + b^2 / (12 d). The waterplane is across the rays on two sides, which the map lays
  // otherwise for the others: a plane along the rays turns whole ones on and off.
  struct Side {
    Vec3 up;
    double height, least_width;
  };
  const Side sides[] = {{Vec3::UnitZ(), 12, 20}, {Vec3::UnitY(), 20, 12}, {Vec3::UnitX(), 40, 12}};
  const double share[] = {0.65, 0.8};
  for (const Side& side : sides) {
    RunConfig config = box({40, 20, 12});
    config.problem = "float";
    config.body.density = 0.8;
    config.body.up = side.up;
    const OrientationMap map = map_of({MapRun(config), {side.up, -side.up}, {"65%", "80%"}});
    EXPECT_EQ(map.cases, (std::vector<std::string>{"65%", "80%"}));
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t c = 0; c < 2; ++c) {
        const MapAnswer& answer = map.at(a, c);
        ASSERT_EQ(answer.status, MapAnswer::feasible) << side.height << ' ' << a << ' ' << c;
        const double d = share[c] * side.height, b = side.least_width;
        // The file holds floats.
        EXPECT_NEAR(answer.verdict.values.at("draft_mm"), d, 1e-4);
        EXPECT_NEAR(answer.verdict.values.at("metacentric_height_mm") +
                        answer.verdict.values.at("centre_of_mass_z_mm"),
                    d / 2 + b * b / (12 * d), 1e-4);
        EXPECT_NEAR(map.at(0, c).objective, map.at(1, c).objective, 1e-6) << "either way up";
      }
  }
}

TEST_F(Map, OfAFloatingBodyAgreesWithRunsWhoseGridIsTurned) {
  RunConfig config = box({40, 30, 24});
  config.grid.resolution = 48;
  config.problem = "float";
  config.body.density = 0.8;
  const OrientationMap map =
      map_of({MapRun(config), {{0.3, 0.1, 1}, {0.2, 1, -0.4}, {-1, 0.2, 0.3}}, {"60%"}});
  for (std::size_t a = 0; a < 3; ++a) {
    RunConfig turned = config;
    turned.body.up = map.axes[a];
    turned.body.contact = map.contacts[a];
    turned.settings["problem.draft"] = "60%";
    const RunResult plain = run(turned).result;
    ASSERT_EQ(plain.outcome.termination, Termination::optimal) << a;
    ASSERT_EQ(map.at(a, 0).status, MapAnswer::feasible) << a;
    // Faces along a grid gain or lose up to half a cell each, both ends together 1/48 of the length.
    EXPECT_NEAR(map.at(a, 0).objective, plain.outcome.objective, plain.outcome.objective / 48) << a;
  }
}

TEST_F(Map, RefusesWhatItCannotMap) {
  RunConfig config = box({40, 20, 12});
  EXPECT_THROW((void)map_of({MapRun(config), {}, {}}), InputError);
  EXPECT_THROW((void)map_of({MapRun(config), {Vec3::Zero()}, {}}), InputError);
  EXPECT_THROW((void)map_of({MapRun(config), {Vec3::UnitZ()}, {"50%"}}), InputError);
  config.problem = "float";
  EXPECT_THROW((void)map_of({MapRun(config), {Vec3::UnitZ()}, {}}), InputError);
  config.problem = "stand";
  EXPECT_THROW((void)map_of({MapRun(config), {Vec3::UnitZ()}, {}}), InputError);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
