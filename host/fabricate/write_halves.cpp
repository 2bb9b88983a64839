#include "fabricate/write_halves.hpp"

#include <utility>

#include "file/beside.hpp"
#include "mesh/io/read.hpp"
#include "mesh/io/write.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/separate_edges.hpp"

namespace kreisel::core {

namespace {

/// Millimetres along the body's axes.
Frame in_millimetres(Frame frame) {
  frame.length = 1;
  return frame;
}

}  // namespace

TriangleMesh half_along_axle(const Frame& frame, const TriangleMesh& mesh, bool upper) {
  const Frame along = in_millimetres(frame);
  return to_model(along, half_of(to_body(along, mesh), upper));
}

std::vector<std::filesystem::path> write_halves(const std::filesystem::path& file,
                                                const std::vector<TriangleMesh>& parts, const Frame& frame,
                                                const Axle& axle) {
  std::vector<TriangleMesh> upper, lower;
  for (const TriangleMesh& part : parts)
    for (const bool above : {true, false})
      if (TriangleMesh half = half_along_axle(frame, part, above); !half.triangles.empty())
        (above ? upper : lower).push_back(std::move(half));
  std::vector<std::filesystem::path> files;
  const auto write = [&](const char* name, const std::vector<TriangleMesh>& meshes) {
    const std::filesystem::path path = beside(file, name);
    write_mesh(path, meshes);
    TriangleMesh mesh = read_mesh(path);
    (void)separate_edges(mesh);
    require_solid(mesh, path.filename().string());
    files.push_back(path);
  };
  write("upper", upper);
  write("lower", lower);
  write("axle", {to_model(in_millimetres(frame), axle_mesh(axle))});
  return files;
}

}  // namespace kreisel::core
