// nest_project.cl - the vertices of both meshes in the two views of a cut. [Nest, s. 5]
//
// in    vertex   float [4*vertices]    x y z 1, A's then B's, nesting units
//       view     NestView [2]          one a half
// out   point    int4  [2*vertices]    x, y in steps of a pixel; depth w and depth beyond the plane as floats
//       outside  int   [1]             the first vertex of B outside a view; set to INT_MAX before
// one item a vertex and view; x, y of vertices far outside are cut off at 4 times the view
#include "nest_raster_params.h"

static inline float row(const global float* m, float4 v) {
  return fma(m[0], v.x, fma(m[1], v.y, fma(m[2], v.z, m[3])));
}

kernel void nest_project(NestRaster p, const global NestView* view, const global float4* vertex, global int4* point,
                         global int* outside) {
  const int i = get_global_id(0), second = i >= p.vertices;
  if (i >= 2 * p.vertices) return;
  const int v = i - second * p.vertices;
  const global NestView* mine = view + second;
  const global float* m = v < p.inner ? mine->a : mine->b;
  const float x = row(m, vertex[v]), y = row(m + 4, vertex[v]), w = row(m + 8, vertex[v]);
  const float limit = 4.0f * p.width;
  const float side = w - fma(mine->plane[1], x, fma(mine->plane[2], y, mine->plane[0]));
  const int4 out = {convert_int_rte(clamp(x, -limit, limit) * NEST_STEPS),
                    convert_int_rte(clamp(y, -limit, limit) * NEST_STEPS), as_int(w), as_int(side)};
  point[i] = out;
  if (v >= p.inner && !(x >= 0 && y >= 0 && x <= p.width && y <= p.width)) atomic_min(outside, v);
}
