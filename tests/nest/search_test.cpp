#include <gtest/gtest.h>

#include "nest/exact.hpp"
#include "nest/hybrid.hpp"
#include "nest/known_answers.hpp"
#include "nest/random_placements.hpp"
#include "nest/scale_search.hpp"
#include "refusal.hpp"
#include "test_device.hpp"

namespace kreisel::nest {
namespace {

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

}  // namespace
}  // namespace kreisel::nest
