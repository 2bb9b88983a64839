#include "fabricate/write_halves.hpp"

#include <fmt/format.h>

#include "mesh/io/read.hpp"
#include "mesh/io/write.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/separate_edges.hpp"

namespace kreisel::core {

std::vector<std::filesystem::path> write_halves(const std::filesystem::path& file,
                                                const std::vector<TriangleMesh>& parts, Frame frame,
                                                const Axle& axle) {
  frame.length = 1;  // millimetres along the body's axes
  std::vector<TriangleMesh> upper, lower;
  for (const TriangleMesh& part : parts) {
    const TriangleMesh local = to_body(frame, part);
    for (const bool above : {true, false})
      if (TriangleMesh half = half_of(local, above); !half.triangles.empty())
        (above ? upper : lower).push_back(to_model(frame, std::move(half)));
  }
  std::vector<std::filesystem::path> files;
  const auto write = [&](const char* name, const std::vector<TriangleMesh>& meshes) {
    std::filesystem::path path = file;
    path.replace_filename(fmt::format("{}-{}{}", file.stem().string(), name, file.extension().string()));
    write_mesh(path, meshes);
    TriangleMesh mesh = read_mesh(path);
    (void)separate_edges(mesh);
    require_solid(mesh, path.filename().string());
    files.push_back(path);
  };
  write("upper", upper);
  write("lower", lower);
  write("axle", {to_model(frame, axle_mesh(axle))});
  return files;
}

}  // namespace kreisel::core
