// cgal_check.cpp - what CGAL says of a mesh: is it closed, does it run through itself, does it bound a
// volume?
//
//   cgal_check FILE...   one line each: file triangles N closed B self_intersects B bounds_volume B volume V
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <cstdio>

#include "read_stl.hpp"

namespace pmp = CGAL::Polygon_mesh_processing;

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    Mesh mesh;
    if (!read_stl(argv[i], mesh)) {
      std::printf("%s no surface\n", argv[i]);
      continue;
    }
    const bool closed = CGAL::is_closed(mesh), crosses = pmp::does_self_intersect(mesh);
    std::printf("%s triangles %zu closed %d self_intersects %d bounds_volume %d volume %.9g\n", argv[i],
                std::size_t(mesh.number_of_faces()), closed, crosses,
                closed && !crosses && pmp::does_bound_a_volume(mesh), CGAL::to_double(pmp::volume(mesh)));
  }
  return 0;
}
