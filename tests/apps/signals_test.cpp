// signals_test.cpp - SIGINT and SIGTERM at any moment: the programs end within a second and leave nothing
// behind.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "apps/run_design.hpp"
#include "body/models/geodesic.hpp"
#include "mesh/io/write.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Seconds that `command` goes on after the signal, and its exit code; it ends before it or not.
struct Ending {
  double seconds = 0;
  int code = 0;
  std::string out;
};

Ending signalled(const std::string& command, const char* signal, double after) {
  // A shell without a terminal has its jobs pass over SIGINT until they ask for it, as the programs do at
  // once.
  const BenchAnswer a = shell(
      fmt::format("{} & pid=$!; sleep {}; from=$(date +%s%N); kill -{} $pid 2>/dev/null; wait $pid; code=$?\n"
                  "echo \"took $(($(date +%s%N) - from)) code $code\"",
                  command, after, signal));
  Ending ending{0, -1, a.out};
  const std::size_t at = a.out.rfind("took ");
  if (at != std::string::npos)
    (void)std::sscanf(a.out.c_str() + at, "took %lf code %d", &ending.seconds, &ending.code);
  ending.seconds *= 1e-9;
  return ending;
}

TEST(Signals, EndTheProgramsWithinASecondWhateverIsUnderWay) {
  const TemporaryFolder folder;
  const std::string mesh = (folder.path / "ball.ply").string();
  TriangleMesh ball = geodesic_sphere(96);
  for (Vec3& v : ball.vertices) v = 20 * Vec3(v[0], v[1], 0.7 * v[2]);
  write_mesh(mesh, {ball});
  const std::string part = (folder.path / "part.stl").string();
  const std::string inspect = fmt::format("'{}' inspect {}", bench_program, mesh);
  const std::string design = fmt::format("'{}' spin {} -o {} --resolution 96", design_program, mesh, part);
  constexpr double within = 1.5;  // a second, on a machine that does other work
  for (const std::string& command : {inspect, design})
    for (const double after : {0.3, 0.8, 1.5, 2.5})
      for (const char* signal : {"INT", "TERM"}) {
        const Ending ending = signalled(command, signal, after);
        EXPECT_LT(ending.seconds, within) << command << " after " << after << ": " << ending.out;
        if (ending.code != 0) {
          EXPECT_TRUE(ending.code == 130 || ending.code == 128 + 15 || ending.code == 128 + 2) << ending.out;
          EXPECT_FALSE(std::filesystem::exists(part)) << ending.out;
        }
        for (const auto& entry : std::filesystem::directory_iterator(folder.path))
          EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
        std::filesystem::remove(part);
      }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
