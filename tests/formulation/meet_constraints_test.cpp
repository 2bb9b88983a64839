#include "formulation/meet_constraints.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "domain/test_bodies.hpp"
#include "fabricate/void_surface.hpp"
#include "mesh/solid/check.hpp"
#include "solve/test_tasks.hpp"

namespace kreisel::core {
namespace THIS_FILE {

const Columns& box() { return BoxDomain::columns(); }

const MassModel& mass() {
  static const MassModel model;  // the domain alone, at full contrast
  return model;
}

constexpr double voxel = BoxDomain::h * BoxDomain::h * BoxDomain::h;

/// The lowest `layers` of every interval solid.
VoxelSet filled_to(int layers) {
  VoxelSet set(box(), false);
  for (std::size_t i = 0; i < box().intervals.size(); ++i)
    for (int k = 0; k < layers; ++k) set.set(set.first(i) + static_cast<std::size_t>(k), true);
  return set;
}

TEST(MeetConstraints, FillsHalfALayerThatRoundingLeftOut) {
  // 3.5 of 8 layers of 24 voxels: every ray rounds the same way, 12 voxels are missing.
  VoxelSet set = filled_to(3);
  const LowestMass problem(84 * voxel);
  EXPECT_EQ(meet_constraints(set, problem, mass()), 12u);
  EXPECT_EQ(set.count_solid(), 84u);
  // The first moments hold, too, to what one voxel half a box away could still do.
  EXPECT_LE(violation(problem, moments(set)), voxel / 2);
}

TEST(MeetConstraints, EmptiesWhatRoundingFilledTooMuch) {
  VoxelSet set = filled_to(4);
  const LowestMass problem(88 * voxel);
  EXPECT_EQ(meet_constraints(set, problem, mass()), 8u);
  EXPECT_EQ(set.count_solid(), 88u);
}

TEST(MeetConstraints, StopsWithinOneVoxelOfWhatCannotBeMet) {
  VoxelSet set = filled_to(3);
  const LowestMass problem(75.4 * voxel);
  (void)meet_constraints(set, problem, mass());
  EXPECT_LE(violation(problem, moments(set)), voxel);
}

TEST(MeetConstraints, LeavesAloneWhatHolds) {
  VoxelSet set = filled_to(3);
  EXPECT_EQ(meet_constraints(set, LowestMass(72 * voxel), mass()), 0u);
  EXPECT_EQ(set.count_solid(), 72u);
}

TEST(MeetConstraints, MovesVoxelsAtTheSurfaceOfTheVoidOnlyAndEachOnce) {
  // Far more is asked than one layer on either side of the surface holds: it stops there.
  VoxelSet set = filled_to(3);
  (void)meet_constraints(set, LowestMass(190 * voxel), mass());
  for (std::size_t i = 0; i < box().intervals.size(); ++i)
    for (int k = 1; k < BoxDomain::layers; ++k)
      EXPECT_GE(set.solid(set.first(i) + static_cast<std::size_t>(k) - 1),
                set.solid(set.first(i) + static_cast<std::size_t>(k)))
          << "no island above a void";
}

TEST(MeetConstraints, KeepsTheSurfaceAManifold) {
  for (int extra = 1; extra < 24; ++extra) {
    VoxelSet set = filled_to(3);
    (void)meet_constraints(set, LowestMass((72 + extra) * voxel), mass());
    VoxelSet again = set;
    EXPECT_EQ(make_well_composed(again), 0u) << extra;
    EXPECT_TRUE(inspect(void_surface(set)).watertight()) << extra;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
