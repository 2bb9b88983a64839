// bad_input_test.cpp - sizes, budgets and coincidences at their ends.
#include <gtest/gtest.h>

#include "nest/known_answers.hpp"
#include "nest/search/optimise.hpp"
#include "refusal.hpp"
#include "test_device.hpp"

namespace kreisel::core::nest {
namespace THIS_FILE {

constexpr std::array variants_of_tests = {"peel", "envelope", "exact", "hybrid"};

Placement centred(const Nesting& nesting, double scale, const Vec3& normal = Vec3::UnitZ()) {
  Placement placement{{}, Cut::through(nesting.to_units(Vec3::Zero()), normal)};
  placement.pose.scale = scale;
  placement.pose.centroid = nesting.to_units(nesting.inner_centroid());
  return placement;
}

/// Of a box the faces along the removal direction are edge-on, and at scale 1 all faces coincide.
TEST(BadInput, FacesEdgeOnAreNoObstacleAndCoincidentOnesAreTouched) {
  const TriangleMesh box = box_mesh(Vec3::Constant(-1), Vec3::Constant(1));
  const Nesting nesting(box, box);
  for (const char* name : variants_of_tests) {
    const auto test = make_feasibility(name, test_device(), nesting);
    for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, -1, 0)}) {
      EXPECT_TRUE(test->check(centred(nesting, 0.99, normal)).valid()) << name;
      EXPECT_FALSE(test->check(centred(nesting, 1, normal)).valid()) << name;
    }
    const double found = make_search(name, test_device(), nesting)->search(centred(nesting, 1), {}).scale;
    EXPECT_LT(found, 1) << name;
    EXPECT_GT(found, 0.998) << name << ": a pixel is 1/256 of the box, and a face in between counts as one";
  }
}

TEST(BadInput, AShapeThatIsLargerNestsAtTheScaleAtWhichItFits) {
  const Nesting nesting(ball(8), ball(8, Vec3::Constant(5)));
  EXPECT_NEAR(nesting.largest_scale(), 0.2, 1e-12);
  const auto search = make_search("hybrid", test_device(), nesting);
  SearchLimits limits;
  limits.upper = nesting.largest_scale();
  EXPECT_NEAR(search->search(centred(nesting, 1), limits).scale, 0.2, 0.002) << "sagitta of frequency 8: 1 %";
  for (const char* name : variants_of_tests)
    EXPECT_FALSE(make_feasibility(name, test_device(), nesting)->check(centred(nesting, 1)).valid()) << name;
}

TEST(BadInput, PlanesThatMissAreInvalidForAllOfThem) {
  const Nesting nesting(ball(8), ball(8));
  const auto whole = [&](double offset) {
    Placement placement = centred(nesting, 0.2);
    placement.cut.offset = offset;
    return placement;
  };
  for (const char* name : variants_of_tests) {
    const auto test = make_feasibility(name, test_device(), nesting);
    EXPECT_FALSE(test->check(whole(1.5)).valid()) << name;
    EXPECT_FALSE(test->check(whole(-1.5)).valid()) << name;
    // Of a copy that lies between the pixels nothing is seen.
    EXPECT_LT(make_search(name, test_device(), nesting)->search(whole(1.5), {}).scale, 1.0 / 256) << name;
  }
}

TEST(BadInput, TwoMillionTrianglesAreAnswered) {
  const Nesting nesting(ball(317), ball(6));
  ASSERT_GT(nesting.outer().triangles.size(), 2'000'000u);
  for (const char* name : {"envelope", "hybrid"}) {
    const auto test = make_feasibility(name, test_device(), nesting);
    EXPECT_TRUE(test->check(centred(nesting, 0.99)).valid()) << name;
    EXPECT_FALSE(test->check(centred(nesting, 1.02)).valid()) << name;
  }
  EXPECT_TRUE(make_feasibility("exact", test_device(), nesting)->check(centred(nesting, 0.99)).valid());
}

TEST(BadInput, TheLargestViewIsDrawnInTurns) {
  const Nesting nesting(ball(6), ball(6));
  const auto test = make_feasibility("envelope", test_device(), nesting, 16384);
  EXPECT_TRUE(test->check(centred(nesting, 0.9)).valid());
}

/// Its layers take 8.5 GiB and minutes to draw: of a device that has them, only that they are had is tested.
TEST(BadInput, PeelingTheLargestViewIsRefusedByADeviceThatCannotHoldItsLayers) {
  const Nesting nesting(ball(6), ball(6));
  const double layers = 2.0 * 16384 * 16384 * 17;  // bytes
  if (double(test_device().info().memory_bytes) * 0.8 < layers) {
    expect_refusal([&] { (void)make_feasibility("peel", test_device(), nesting, 16384); },
                   "resolution 16384: peeling keeps 8.5 GiB", {"expected a coarser one, or envelope"});
    return;
  }
  const auto test = make_feasibility("peel", test_device(), nesting, 16384);
  EXPECT_EQ(test->check(centred(nesting, 3)).fault, Fault::outside);
}

TEST(BadInput, OneParticleAndNoIterationsAreASearchAllTheSame) {
  const Nesting nesting(ball(6), ball(6));
  OptimiseSpec spec;
  spec.freedom.set_free("all");
  spec.freedom.given = centred(nesting, 1);
  spec.search.swarm.particles = 1;
  spec.search.swarm.iterations = 0;
  spec.search.climbs = 0;
  for (const std::string_view variant : variants()) {
    spec.variant = variant;
    const OptimiseResult result = optimise(nesting, test_device(), spec);
    EXPECT_EQ(result.state.evaluations(), 1u) << variant;
    EXPECT_FALSE(result.ended_early) << variant;
  }
  spec.search.climb.iterations = 20;
  spec.search.climbs = 1;
  spec.search.swarm.iterations = 1;
  EXPECT_TRUE(optimise(nesting, test_device(), spec).best);
}

TEST(BadInput, NothingFreeIsASearchOfTheScaleAlone) {
  const Nesting nesting(ball(6), ball(6));
  OptimiseSpec spec;
  spec.freedom.set_free("none");
  spec.freedom.given = centred(nesting, 1);
  spec.search.swarm.particles = 2;
  spec.search.swarm.iterations = 1;
  const OptimiseResult result = optimise(nesting, test_device(), spec);
  ASSERT_TRUE(result.best);
  EXPECT_GT(result.best->pose.scale, 0.9) << "the cut runs across triangles of 10 degrees";
  spec.upper = 0.5;
  EXPECT_LE(optimise(nesting, test_device(), spec).best->pose.scale, 0.5);
  spec.upper = -1;
  expect_refusal([&] { (void)optimise(nesting, test_device(), spec); }, "upper bound -1 of the scale",
                 {"> 0"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::nest
