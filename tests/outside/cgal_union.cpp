// cgal_union.cpp - the volume of what two solids enclose together, as CGAL has it.
//
//   cgal_union A.stl B.stl   prints "union V", or "no union" with why
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <cstdio>

#include "read_stl.hpp"

int main(int argc, char** argv) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  Mesh a, b, both;
  if (argc != 3 || !read_stl(argv[1], a) || !read_stl(argv[2], b)) {
    std::puts("no union: two binary STL files that are surfaces, please");
    return 2;
  }
  if (!pmp::corefine_and_compute_union(a, b, both)) {
    std::puts("no union: its boundary is no manifold");
    return 1;
  }
  std::printf("union %.9g\n", CGAL::to_double(pmp::volume(both)));
  return 0;
}
