// nest_project.cl - the vertices of both meshes in the two views of a cut. [Nest, s. 5]
//
// in    vertex   float [3*stride]    all x, all y, all z, nesting units: A's vertices, then B's, each padded to whole
//                                    groups of 16 by repeating the last
//       view     NestView [2]        one a half
// out   point    int4  [2*vertices]  x, y in steps of a pixel; depth w and depth beyond the plane as floats
//       outside  int   [1]           a group of B that holds a vertex outside a view, the first; INT_MAX before
// one item a group of 16 vertices, both views; x, y of vertices far outside are cut off at 4 times the view
#include "nest_raster_params.h"

static inline float16 row(const global float* m, float16 x, float16 y, float16 z) {
  return fma((float16)m[0], x, fma((float16)m[1], y, fma((float16)m[2], z, (float16)m[3])));
}

static inline int16 steps(float16 x, float limit) {
  return convert_int16(rint(clamp(x, (float16)-limit, (float16)limit) * (float)NEST_STEPS));
}

kernel void nest_project(NestRaster p, const global NestView* view, const global float* vertex, global int4* point,
                         global int* outside) {
  const int group = get_global_id(0), first = 16 * group;
  if (first >= p.vertices) return;
  const float16 vx = vload16(group, vertex), vy = vload16(group, vertex + p.vertices),
                vz = vload16(group, vertex + 2 * (size_t)p.vertices);
  for (int k = 0; k < 2; ++k) {
    const global NestView* mine = view + k;
    const global float* m = first < p.inner ? mine->a : mine->b;
    const float16 x = row(m, vx, vy, vz), y = row(m + 4, vx, vy, vz), w = row(m + 8, vx, vy, vz);
    const float16 side = w - fma((float16)mine->plane[1], x, fma((float16)mine->plane[2], y, (float16)mine->plane[0]));
    const float width = p.width;
    const int16 px = steps(x, 4 * width), py = steps(y, 4 * width), pw = as_int16(w), ps = as_int16(side);
    global int* out = (global int*)(point + k * (size_t)p.vertices + first);
    for (int upper = 0; upper < 2; ++upper) {
      const int16 xy = (upper ? (int16)(px.hi, py.hi) : (int16)(px.lo, py.lo)).s08192a3b4c5d6e7f;
      const int16 ws = (upper ? (int16)(pw.hi, ps.hi) : (int16)(pw.lo, ps.lo)).s08192a3b4c5d6e7f;
      vstore16(((int16)(xy.lo, ws.lo)).s018923ab45cd67ef, 2 * upper, out);
      vstore16(((int16)(xy.hi, ws.hi)).s018923ab45cd67ef, 2 * upper + 1, out);
    }
    if (first >= p.inner && any(~((x >= 0) & (y >= 0) & (x <= width) & (y <= width)))) atomic_min(outside, group);
  }
}
