#include "stop.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "body/models/geodesic.hpp"
#include "mesh/io/write.hpp"
#include "mesh/mesh_folder.hpp"
#include "mesh/solid/surface.hpp"
#include "parallel.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(StopScope, IsOfOneThreadAndOfThoseThatItsLoopsStart) {
  std::stop_source source;
  source.request_stop();
  EXPECT_NO_THROW(stop_here());
  {
    const StopScope scope(source.get_token());
    EXPECT_THROW(stop_here(), Interrupted);
    EXPECT_THROW(parallel_for(8, [](std::size_t) {}), Interrupted);
    {
      const StopScope none({});
      EXPECT_NO_THROW(parallel_for(8, [](std::size_t) { stop_here(); }));
    }
    EXPECT_THROW(stop_here(), Interrupted);
  }
  EXPECT_NO_THROW(stop_here());
}

TEST(StopScope, EndsALoopThatIsUnderWay) {
  std::stop_source source;
  const StopScope scope(source.get_token());
  std::atomic<int> done = 0;
  EXPECT_THROW(parallel_for(1000,
                            [&](std::size_t) {
                              if (++done == 10) source.request_stop();
                            }),
               Interrupted);
  EXPECT_LT(done, 100);
}

class StoppedMesh : public MeshFolder {};

/// Whatever is done with a mesh asks, however it is read.
TEST_F(StoppedMesh, IsNeitherReadNorCheckedNorWritten) {
  const TriangleMesh mesh = geodesic_sphere(4);
  std::stop_source source;
  source.request_stop();
  for (const char* name : {"a.off", "a.obj", "a.ply", "a.stl", "a.3mf"}) {
    write_mesh(folder_ / name, {mesh});
    const StopScope scope(source.get_token());
    EXPECT_THROW((void)read_mesh(folder_ / name), Interrupted) << name;
  }
  const std::pair<const char*, std::function<void()>> work[] = {
      {"inspect", [&] { (void)inspect(mesh); }},
      {"repair", [&] { (void)Surface(mesh); }},
      {"crossings", [&] { (void)Surface::as_it_is(mesh).crossings(); }},
      {"shells", [&] { (void)shells(mesh); }},
      {"write", [&] { write_mesh(folder_ / "b.stl", {mesh}); }}};
  const StopScope scope(source.get_token());
  for (const auto& [name, run] : work) EXPECT_THROW(run(), Interrupted) << name;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.stl"));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
