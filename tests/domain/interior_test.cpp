#include "domain/interior.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "body/models.hpp"
#include "domain/columns.hpp"
#include "domain/test_bodies.hpp"
#include "mesh/query/distance.hpp"

namespace kreisel::core {
namespace THIS_FILE {

struct Plain {
  std::vector<Interval> intervals;
  std::size_t inside = 0, interior = 0;
};

/// What a domain is by definition: every centre in the solid, asked for its own distance.
Plain plain_columns(const Body& body, const Columns& domain) {
  Plain plain;
  const Grid& grid = domain.grid;
  const auto crossings = column_crossings(body.local, grid);
  const SurfaceDistance distance(body.local);
  const double shell = domain.wall - 1e-9 * grid.h;
  for (int iy = 0; iy < grid.n[1]; ++iy)
    for (int ix = 0; ix < grid.n[0]; ++ix) {
      bool open = false;
      for (int k = 0; k < grid.n[2]; ++k) {
        const Vec3 centre(grid.centre(0, ix), grid.centre(1, iy), grid.centre(2, k));
        int winding = 0;
        for (const Crossing& c : crossings[ix + static_cast<std::size_t>(grid.n[0]) * iy])
          if (c.z <= centre[2]) winding += c.winding;
        const bool interior = winding > 0 && distance(centre, shell) >= shell;
        plain.inside += winding > 0;
        plain.interior += interior;
        if (interior && !open)
          plain.intervals.push_back(
              {static_cast<std::uint16_t>(ix), static_cast<std::uint16_t>(iy), k, k + 1});
        else if (interior)
          plain.intervals.back().k1 = k + 1;
        open = interior;
      }
    }
  return plain;
}

void expect_as_if_every_voxel_were_asked(const TriangleMesh& mesh, int resolution, const Wall& wall) {
  SCOPED_TRACE(to_string(wall) + " at " + std::to_string(resolution));
  const Body body = body_of(mesh);
  GridSpec spec;
  spec.resolution = resolution;
  const Columns got = make_columns(body, spec, wall);
  const Plain want = plain_columns(body, got);
  EXPECT_EQ(got.inside_voxels, want.inside);
  EXPECT_EQ(got.interior_voxels, want.interior);
  ASSERT_EQ(got.intervals.size(), want.intervals.size());
  for (std::size_t i = 0; i < want.intervals.size(); ++i) {
    const Interval &a = got.intervals[i], &b = want.intervals[i];
    ASSERT_TRUE(a.ix == b.ix && a.iy == b.iy && a.k0 == b.k0 && a.k1 == b.k1)
        << "interval " << i << " of column " << b.ix << ", " << b.iy;
  }
}

TEST(Interior, OfModelsIsAsIfEveryVoxelWereAsked) {
  for (const char* name : {"bird", "ellipsoid"}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = find_model(name)->make(12);
    // Walls thinner and thicker than a block of cells; grids that are no multiple of one.
    for (const int resolution : {9, 31, 64})
      for (const Wall& wall : {Wall{0.87, Wall::cells}, Wall{1.5, Wall::cells}, Wall{12, Wall::percent}})
        expect_as_if_every_voxel_were_asked(mesh, resolution, wall);
  }
}

TEST(Interior, OfThinAndBranchingShapesIsAsIfEveryVoxelWereAsked) {
  for (const double cells : {0.9, 2.5, 3.7}) {
    expect_as_if_every_voxel_were_asked(upright_torus_mesh(0.75, 0.25, 48, 24), 57, {cells, Wall::cells});
    expect_as_if_every_voxel_were_asked(letter_c_mesh(2), 48, {cells, Wall::cells});
  }
}

TEST(Interior, OfABoxWhoseWallEndsOnCentresIsAsIfEveryVoxelWereAsked) {
  // Whole layers of centres are as deep as the wall but for round-off: the blocks may not decide otherwise.
  const TriangleMesh box = box_mesh({0.1, 0.2, 0.3}, {1.7, 1.4, 1.2});
  for (const double cells : {1.5, 2.5, 4.5})
    expect_as_if_every_voxel_were_asked(box, 32, {cells, Wall::cells});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
