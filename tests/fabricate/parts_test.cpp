#include "fabricate/parts.hpp"

#include <gtest/gtest.h>

#include <random>

#include "domain/test_bodies.hpp"
#include "fabricate/verify.hpp"
#include "problem/balance.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

struct Densities {
  double shell, interior, voids;
  std::vector<std::string> names;  ///< of the parts to make
};

const std::vector<Densities>& densities() {
  static const std::vector<Densities> all = {{1, 1, 0, {"part"}},
                                             {1, 1, 0.5, {"part", "filling"}},
                                             {1, 1, 8, {"part", "filling"}},
                                             {1.25, 8, 0, {"shell", "interior"}},
                                             {1.25, 8, 0.5, {"shell", "interior", "filling"}},
                                             {2, 0.5, 4, {"shell", "interior", "filling"}}};
  return all;
}

/// [-1, 1]^2 x [0, 2] mm, in millimetres as well as in body units.
Body block(const Densities& of) {
  Body body = body_of(box_mesh({-1, -1, 0}, {1, 1, 2}));
  body.density = of.shell;
  body.interior_density = of.interior;
  body.void_density = of.voids;
  return body;
}

std::vector<std::string> names_of(const std::vector<MaterialPart>& parts) {
  std::vector<std::string> names;
  for (const MaterialPart& part : parts) names.push_back(part.name);
  return names;
}

TEST(Parts, OfVoxelsWeighInWhatIsWrittenWhatTheMassModelSays) {
  const TemporaryFolder folder;
  std::mt19937 engine(5);
  for (const Densities& of : densities())
    for (const char* const file : {"part.stl", "part.3mf"}) {
      const Body body = block(of);
      GridSpec spec;
      spec.resolution = 8;  // spacing 1/4: exact in the single precision of files
      const Columns domain = make_columns(body, spec, {1, Wall::cells});
      VoxelSet heavy(domain, false);
      for (std::size_t v = 0; v < heavy.size(); ++v) heavy.set(v, engine() % 2 == 0);
      make_well_composed(heavy);
      const MassModel mass = hollowed(body, domain.interior);
      const Moments want = mass.total(moments(heavy));

      const Inside inside = inside_of(body, heavy);
      // Sums of some thousand terms of order one and less.
      EXPECT_LE((moments_of(body, inside) - want).cwiseAbs().maxCoeff(), 1e-11);
      const std::vector<MaterialPart> parts = parts_of(body, inside);
      EXPECT_EQ(names_of(parts), of.names);

      const WrittenPart written =
          verify_written(write_parts(folder.path / file, parts), body, Balance({0, 0, 1}, std::nullopt));
      EXPECT_NE(written.verdict.text.find("balance"), std::string::npos) << written.verdict.text;
      EXPECT_LE((written.moments - want).cwiseAbs().maxCoeff(), 1e-11);
      double grams = 0;
      for (const WrittenMaterial& material : written.materials) {
        EXPECT_TRUE(std::filesystem::exists(material.file)) << material.file;
        EXPECT_GT(material.grams, 0);
        grams += material.grams;
      }
      EXPECT_NEAR(grams, want[S1] * body.mass_grams(), 1e-11);
    }
  EXPECT_TRUE(std::filesystem::exists(folder.path / "part-interior.stl"));
  EXPECT_TRUE(std::filesystem::exists(folder.path / "part-filling.stl"));
  EXPECT_FALSE(std::filesystem::exists(folder.path / "part-filling.3mf")) << "3MF holds several objects";
}

TEST(Parts, OfAQuadricFollowTheHeavySide) {
  // The heavier goes below the plane z = 1.1, inside a wall of 0.25.
  const double wall = 0.25, cell = 0.125, level = 1.1;
  const Moments q = Moments::Unit(SZ) - level * Moments::Unit(S1);
  const Vec3 edges(1.5, 1.5, 1.5), centre(0, 0, 1);
  const Moments interior = box_moments(centre, edges);
  const Moments heavy = box_moments({0, 0, (wall + level) / 2}, {1.5, 1.5, level - wall});
  // Twelve edges of a box and four where the plane meets it are cut off by the mesh, a triangle of half a
  // cell's square each at the most.
  const double lost = 16 * 1.5 * cell * cell / 2;
  for (const Densities& of : densities()) {
    const Body body = block(of);
    // This body's unit of mass is its density times one, for its moments are those of unit density.
    const Inside inside = inside_of(body, CavityMesher(body, wall, cell), q);
    const MassModel mass = hollowed(body, interior);
    const double worst = (std::max(of.interior, of.voids) / of.shell + 1) * lost;
    EXPECT_NEAR(moments_of(body, inside)[S1], mass.total(heavy)[S1], worst);
    EXPECT_NEAR(moments_of(body, inside)[SZ], mass.total(heavy)[SZ], 2 * worst);
    const std::vector<MaterialPart> parts = parts_of(body, inside);
    EXPECT_EQ(names_of(parts), of.names);
    if (of.names[0] == "shell") {
      const auto volume = [](const TriangleMesh& mesh) { return reference::mesh_moments(mesh).value[S1]; };
      EXPECT_NEAR(volume(inside.fill) - volume(inside.voids), -volume(inside.interior), lost);
      EXPECT_GT(volume(inside.fill), 0);
    }
  }
}

TEST(Parts, WithoutVoidsOrWithoutFillLeaveThoseOut) {
  const Body body = block({1, 8, 0.5, {}});
  GridSpec spec;
  spec.resolution = 8;
  const Columns domain = make_columns(body, spec, {1, Wall::cells});
  EXPECT_EQ(names_of(parts_of(body, inside_of(body, VoxelSet(domain, true)))),
            (std::vector<std::string>{"shell", "interior"}));
  EXPECT_EQ(names_of(parts_of(body, inside_of(body, VoxelSet(domain, false)))),
            (std::vector<std::string>{"shell", "filling"}));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
