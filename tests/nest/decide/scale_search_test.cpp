#include "nest/decide/scale_search.hpp"

#include <gtest/gtest.h>

#include "nest/decide/exact.hpp"
#include "nest/decide/hybrid.hpp"
#include "nest/known_answers.hpp"
#include "nest/random_placements.hpp"
#include "refusal.hpp"
#include "test_device.hpp"

namespace kreisel::core::nest {
namespace THIS_FILE {

TEST(ExactFeasibility, GivesTheKnownAnswers) {
  for (const KnownAnswer& known : known_answers()) {
    const Nesting nesting(known.outer, known.inner);
    Exact exact(nesting);
    Hybrid hybrid(nesting);
    for (const auto& [scale, valid] : known.answers) {
      const Placement placement = known.at(nesting, scale);
      const Verdict by_pairs = exact.check(placement), by_trees = hybrid.check(placement);
      EXPECT_EQ(by_pairs.valid(), valid)
          << known.name << " at " << scale << ": " << to_string(by_pairs, nesting);
      EXPECT_EQ(by_trees.valid(), valid)
          << known.name << " at " << scale << ": " << to_string(by_trees, nesting);
    }
  }
}

TEST(ExactFeasibility, SearchesAgreeWithItAtEveryScaleAbove) {
  const auto shapes = small_shapes();
  Random random(3);
  const SearchLimits limits;
  int some = 0, none = 0;
  for (std::size_t outer = 0; outer < shapes.size(); ++outer)
    for (std::size_t inner = 0; inner < shapes.size(); ++inner) {
      const Nesting nesting(shapes[outer], shapes[inner]);
      Exact exact(nesting);
      Hybrid hybrid(nesting);
      for (int k = 0; k < 6; ++k) {
        Placement placement = random_placement(random, k % 4 == 0);
        const FoundScale found = hybrid.search(placement, limits);
        (found.scale > 0 ? some : none)++;
        if (found.scale > 0) {
          placement.pose.scale = found.scale;
          EXPECT_TRUE(exact.check(placement).valid())
              << outer << " " << inner << " " << k << ": " << found.scale;
          EXPECT_TRUE(hybrid.check(placement).valid())
              << outer << " " << inner << " " << k << ": " << found.scale;
        }
        for (double s = found.scale + limits.tolerance; s < limits.upper; s += 0.037) {
          placement.pose.scale = s;
          EXPECT_FALSE(exact.check(placement).valid())
              << outer << " " << inner << " " << k << ": " << s << " above " << found.scale;
        }
      }
    }
  EXPECT_GT(some, 30);
  EXPECT_GT(none, 30);
}

const KnownAnswer& known(const std::string& name) {
  static const std::vector<KnownAnswer> all = known_answers();
  for (const KnownAnswer& answer : all)
    if (answer.name == name) return answer;
  throw std::out_of_range(name);
}

double found_by(const char* name, const KnownAnswer& answer, double upper, int resolution = 512) {
  const Nesting nesting(answer.outer, answer.inner);
  SearchLimits limits;
  limits.upper = upper;
  return make_search(name, test_device(), nesting, resolution)->search(answer.at(nesting, 1), limits).scale;
}

TEST(ScaleSearch, FindsTheKnownScales) {
  for (const auto& [name, scale] : {std::pair{"off-centre by 0.3", 0.7},
                                    {"cut at 0.6", 0.8},
                                    {"wide spike", 0.5},
                                    {"plus tilted", std::cos(0.5)},
                                    {"sphere in ellipsoid", 1.0}}) {
    // Sagitta of the spheres' triangles; where sampled half a pixel's diagonal, 0.0028, and five times that
    // along the flanks of the spike.
    for (const char* way : {"exact", "hybrid"})
      EXPECT_NEAR(found_by(way, known(name), 1.2), scale, 0.004) << way;
    EXPECT_NEAR(found_by("envelope", known(name), 1.2), scale, 0.014) << name;
  }
}

TEST(ScaleSearch, NeedsNeitherMonotonicFeasibilityNorAValidZero) {
  // 0.7 (s - 1) + 0.2 s = 0.3 where the inner ring meets the outer's far side, 0.7 (1 - s) + 0.2 s = 0.3 the
  // near.
  const KnownAnswer& rings = known("ring in ring");
  EXPECT_NEAR(found_by("hybrid", rings, 1.5), 1 / 0.9, 0.004);
  EXPECT_EQ(found_by("hybrid", rings, 1.05), 1.05);
  EXPECT_NEAR(found_by("hybrid", rings, 0.81), 0.81, 1e-12);
  EXPECT_EQ(found_by("hybrid", rings, 0.79), 0);
  EXPECT_EQ(found_by("hybrid", known("plane misses A"), 1), 0);
  EXPECT_EQ(found_by("hybrid", known("B outside A"), 1), 0);
}

TEST(ScaleSearch, SeesContactsThatSamplesMiss) {
  // A spike of A meets the middle of a face of B: no vertex of B and no pixel's centre is near.
  KnownAnswer thin;
  thin.outer = spiked_box(0.5, 0.0005);
  thin.inner = box_mesh(Vec3::Constant(-1), Vec3::Constant(1));
  thin.point = {0, 0, 0.3};
  EXPECT_NEAR(found_by("exact", thin, 1), 0.5, 1e-4);
  EXPECT_NEAR(found_by("hybrid", thin, 1), 0.5, 1e-4);
  EXPECT_GT(found_by("envelope", thin, 1), 0.9);
}

TEST(ScaleSearch, StopsBelowWhatIsNotWantedAndOtherwiseAnswersTheSame) {
  const KnownAnswer& answer = known("off-centre by 0.3");
  const Nesting nesting(answer.outer, answer.inner);
  for (const char* name : {"envelope", "hybrid"}) {
    const auto search = make_search(name, test_device(), nesting, 128);
    const Placement placement = answer.at(nesting, 1);
    const FoundScale whole = search->search(placement, {});
    const FoundScale worse = search->search(placement, {1, 0.9, 1e-4}),
                     better = search->search(placement, {1, 0.6, 1e-4});
    EXPECT_TRUE(worse.aborted) << name;
    EXPECT_EQ(worse.scale, 0) << name;
    EXPECT_LE(worse.tests, whole.tests) << name;
    EXPECT_FALSE(better.aborted) << name;
    EXPECT_NEAR(better.scale, whole.scale, 1e-4) << name;
  }
}

TEST(ScaleSearch, OfABatchAnswersInOrderAndTheSameEveryTime) {
  const TriangleMesh shape = small_shapes().back();
  const Nesting nesting(shape, ball(3));
  Random random(4);
  std::vector<Placement> placements;
  for (int k = 0; k < 40; ++k) placements.push_back(random_placement(random, false));
  const std::vector<SearchLimits> limits(placements.size());
  std::vector<std::vector<double>> runs;
  for (int run = 0; run < 2; ++run) {
    Hybrid hybrid(nesting);
    runs.emplace_back();
    for (int round = 0; round < 2; ++round)
      for (const FoundScale& found : hybrid.search(placements, limits)) runs.back().push_back(found.scale);
  }
  EXPECT_EQ(runs[0], runs[1]);
  Hybrid hybrid(nesting);
  for (std::size_t i = 0; i < placements.size(); ++i)
    EXPECT_NEAR(hybrid.search(placements[i], limits[i]).scale, runs[0][i], limits[i].tolerance) << i;
}

TEST(ScaleSearch, RefusesLimitsThatAreNone) {
  const Nesting nesting(ball(2), ball(2));
  Hybrid hybrid(nesting);
  const auto refused = [&](SearchLimits limits, const std::string& start) {
    expect_refusal([&] { (void)hybrid.search(Placement{}, limits); }, start, {});
  };
  refused({0, 0, 1e-4}, "upper bound 0");
  refused({NAN, 0, 1e-4}, "upper bound nan");
  refused({1, -1, 1e-4}, "abort_below -1");
  refused({1, 0, 0}, "tolerance 0");
}

/// Distances of the samples matter, not their number: finer views find smaller scales, down to the exact one.
TEST(ScaleSearch, SampledIsOptimisticByLessThanAPixelsWorthOnSmoothShapes) {
  Random random(6);
  const Nesting nesting(ball(6, {1.2, 1, 0.8}), ball(4));
  Hybrid hybrid(nesting);
  for (int k = 0; k < 12; ++k) {
    const Placement placement = random_placement(random, false);
    const double exact = hybrid.search(placement, {}).scale;
    for (const int resolution : {32, 128}) {
      const double sampled =
          make_search("envelope", test_device(), nesting, resolution)->search(placement, {}).scale;
      const double pixel = 2.0 / resolution;
      // Vertices are rounded by 1/512 of a pixel. A convex B of inner radius 0.4 that misses a contact by
      // half a pixel's diagonal across, at slopes up to the tilt of the views, is too large by a few times
      // that.
      EXPECT_GE(sampled, exact - 2e-4 - pixel / 256) << k << " at " << resolution;
      EXPECT_LE(sampled, exact + 4 * pixel) << k << " at " << resolution;
    }
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::nest
