// union_test.cpp - `bench inspect` on shells that overlap, beside CGAL's union of them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/run_bench.hpp"
#include "body/models/geodesic.hpp"
#include "geometry/moved.hpp"
#include "geometry/single_precision.hpp"
#include "installed.hpp"
#include "mesh/io/write.hpp"
#include "mesh/shapes.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(Union, OfPairsOfShellsWeighsWhatCgalSays) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "not built with sanitizers";
#endif
  KREISEL_NEEDS(std::filesystem::exists(cgal_union_program), "cgal_union");
  const TemporaryFolder folder;
  const std::string a = folder.path / "a.stl", b = folder.path / "b.stl",
                    both_file = folder.path / "both.stl";
  TriangleMesh ball = geodesic_sphere(8);
  for (Vec3& v : ball.vertices) v *= 20;
  TriangleMesh ring = torus(40, 16);
  for (Vec3& v : ring.vertices) v *= 6;
  const TriangleMesh box = box_mesh({-15, -10, -20}, {15, 10, 20});
  Random random(23);
  const std::vector<std::pair<TriangleMesh, TriangleMesh>> pairs{{ball, ball}, {ball, box}, {ring, box},
                                                                 {ring, ring}, {box, box},  {ring, ball}};
  for (const auto& [one, other] : pairs) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = random_rotation(random);
    pose.translation() = random_vec(random, -8, 8);
    const TriangleMesh first = in_single_precision(one), second = in_single_precision(moved(other, pose));
    write_mesh(a, {first});
    write_mesh(b, {second});
    write_mesh(both_file, {both(first, second)});
    const std::string said = shell(fmt::format("'{}' '{}' '{}'", cgal_union_program, a, b)).out;
    ASSERT_EQ(said.find("union "), 0u) << said;
    const BenchAnswer answer = bench(fmt::format("inspect '{}' --json -", both_file));
    ASSERT_EQ(answer.code, 0) << answer.out;
    const double volume = nlohmann::json::parse(answer.out).at("solid").at("volume_mm3");
    EXPECT_NEAR(volume, std::stod(said.substr(6)), 2e-6 * volume);  // corners in single precision
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
