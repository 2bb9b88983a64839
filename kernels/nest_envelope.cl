// nest_envelope.cl - feasibility by two depth envelopes: max w of B, min w of A. [Nest, s. 5] (nest_raster.h)
//
// in    view     NestView [2]
//       point    int4  [2*vertices]   nest_project
//       corner   uint  [3*triangles]  vertices, A's triangles then B's
// out   bad      int4  [2*bands]      of each item its first bad pixel (y * width + x, or INT_MAX), why, its w_B
//       map      uchar [2*width^2]    why each pixel is bad; written only when p.map
//       depth    float16 [3*tiles^2 each item of a launch]  scratch: max B, min back-facing A, min front-facing A
// one item a band of tile rows of one view, which goes through all triangles: no atomics, and the order of triangles
// does not show, for max and min have none. A is drawn only where B is.
#include "nest_raster.h"

#define FAR ((float16)INFINITY)

kernel void nest_envelope(NestRaster p, const global NestView* view, const global int4* point,
                          const global uint* corner, global float16* depth, global int4* bad, global uchar* map) {
  if (get_global_id(0) % NEST_SPREAD) return;
  const int local_item = get_global_id(0) / NEST_SPREAD, item = p.first_item + local_item;
  if (item >= 2 * p.bands) return;
  const int second = item / p.bands;
  const int row0 = item % p.bands * p.band, row1 = min(row0 + p.band, p.tiles) - 1;
  const global int4* seen = point + second * (size_t)p.vertices;
  const float plane[3] = {view[second].plane[0], view[second].plane[1], view[second].plane[2]};
  global float16* mine = depth + 3 * (size_t)p.tiles * p.band * local_item;
#define LANE(t) (4 * ((t).py & 3) + ((t).px & 3))
#define TILE(tx, ty) (mine + 3 * ((size_t)((ty)-row0) * p.tiles + (tx)))

  for (int ty = row0; ty <= row1; ++ty)
    for (int tx = 0; tx < p.tiles; ++tx) *TILE(tx, ty) = -FAR;
  NestTriangle t;
  int16 covered;
  int one;
  int left = p.tiles, right = -1, bottom = p.tiles, top = -1;  // tiles that hold B
  for (int i = p.first_b; i < p.triangles; ++i) {
    const global uint* c = corner + 3 * (size_t)i;
    if (!nest_triangle(&t, seen[c[0]], seen[c[1]], seen[c[2]], 0, row0, p.tiles - 1, row1)) continue;
    left = min(left, t.tx0), right = max(right, t.tx1), bottom = min(bottom, t.ty0), top = max(top, t.ty1);
    if (t.single) {
      const float w = nest_fragment(&t, plane, &one);
      global float* b = (global float*)TILE(t.tx0, t.ty0) + LANE(t);
      if (one) *b = max(*b, w);
      continue;
    }
    for (int ty = t.ty0; ty <= t.ty1; ++ty)
      for (int tx = t.tx0; tx <= t.tx1; ++tx) {
        const float16 w = nest_fragments(&t, plane, tx, ty, &covered);
        global float16* b = TILE(tx, ty);
        *b = max(*b, select(-FAR, w, covered));
      }
  }
  for (int ty = bottom; ty <= top; ++ty)
    for (int tx = left; tx <= right; ++tx) TILE(tx, ty)[1] = TILE(tx, ty)[2] = FAR;
  if (top >= 0)
    for (int i = 0; i < p.first_b; ++i) {
      const global uint* c = corner + 3 * (size_t)i;
      if (!nest_triangle(&t, seen[c[0]], seen[c[1]], seen[c[2]], left, bottom, right, top)) continue;
      if (t.single) {
        const float w = nest_fragment(&t, plane, &one);
        global float* a = (global float*)(TILE(t.tx0, t.ty0) + 1 + t.front) + LANE(t);
        if (one) *a = min(*a, w);
        continue;
      }
      for (int ty = t.ty0; ty <= t.ty1; ++ty)
        for (int tx = t.tx0; tx <= t.tx1; ++tx) {
          const float16 w = nest_fragments(&t, plane, tx, ty, &covered);
          global float16* a = TILE(tx, ty) + 1 + t.front;
          *a = min(*a, select(FAR, w, covered));
        }
    }

  int4 first = {INT_MAX, NEST_GOOD, 0, 0};
  for (int ty = bottom; ty <= top; ++ty)
    for (int tx = left; tx <= right; ++tx) {
      const float16 b = TILE(tx, ty)[0], back = TILE(tx, ty)[1], front = TILE(tx, ty)[2];
      if (!p.map && !any((b > -FAR) & ~((b < back) & (back < front)))) continue;
      for (int k = 0; k < 16; ++k) {
        const int x = 4 * tx + (k & 3), y = 4 * ty + (k >> 2), pixel = y * p.width + x;
        if (x >= p.width || y >= p.width) continue;
        const int fault = nest_fault(((float*)&b)[k], ((float*)&back)[k], ((float*)&front)[k]);
        if (p.map) map[second * (size_t)p.width * p.width + pixel] = fault;
        if (fault == NEST_GOOD || pixel >= first.x) continue;
        const int4 found = {pixel, fault, as_int(((float*)&b)[k]), 0};
        first = found;
      }
    }
  bad[item] = first;
}
