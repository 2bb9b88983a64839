// nest_envelope.cl - feasibility by two depth envelopes: max w of B, min w of A. [Nest, s. 5] (nest_raster.h)
//
// in    view     NestView [2]
//       point    int4  [2*vertices]   nest_project
//       corner   uint  [3*(triangles+15)]  vertices, A's triangles then B's, then any
// out   bad      int4  [2*bands]      of each item its first bad pixel (y * width + x, or INT_MAX), why, its w_B
//       map      uchar [2*width^2]    why each pixel is bad; written only when p.map
//       depth    float16 [3*tiles^2 each item of a launch]  scratch: max of w of B, of -w of back-facing A, of -w of
//                                     front-facing A
// one item a band of tile rows of one view, which goes through all triangles: no atomics, and the order of triangles
// does not show, for max has none. A is drawn only where B is.
#include "nest_raster16.h"

#define FAR ((float16)INFINITY)
#define TILE(tx, ty) (depth + 3 * ((size_t)((ty)-row0) * tiles + (tx)))

typedef struct {
  int left, bottom, right, top;  // tiles, inclusive
} NestBox;

/* Draws triangles [first, last) within a box of tiles. Returns the box of tiles that they may have touched. */
static NestBox draw(int of_a, int first, int last, const global int4* seen, const global uint* corner,
                    const float plane[3], NestBox box, int row0, int tiles, global float16* depth) {
  const float sign = of_a ? -1 : 1;
  NestTriangles s;
  NestTriangle t;
  int16 left = INT_MAX, bottom = INT_MAX, right = -1, top = -1, covered;
  for (int i = first; i < last; i += 16) {
    if (!nest_triangles(&s, seen, corner + 3 * (size_t)i, last - i, box.left, box.bottom, box.right, box.top)) continue;
    left = min(left, select((int16)INT_MAX, s.tx0, s.live)), right = max(right, select((int16)-1, s.tx1, s.live));
    bottom = min(bottom, select((int16)INT_MAX, s.ty0, s.live)), top = max(top, select((int16)-1, s.ty1, s.live));

    const float16 single_w = sign * nest_single_fragments(&s, plane, &covered);
    const int16 other = s.live & ~(s.single & s.small);
    const int16 surface = of_a ? 1 - s.front : (int16)0;
    const int16 place = 16 * (3 * ((s.ty0 - row0) * tiles + s.tx0) + surface) + 4 * (s.py & 3) + (s.px & 3);
    // Which, without a branch for each: those come as they like.
    int hit[16], others[16], hits = 0, n = 0;
    for (int k = 0; k < 16; ++k) {
      hit[hits] = others[n] = k;
      hits -= ((const int*)&covered)[k], n -= ((const int*)&other)[k];
    }
    for (int j = 0; j < hits; ++j) {
      const int k = hit[j];
      global float* mine = (global float*)depth + ((const int*)&place)[k];
      *mine = max(*mine, ((const float*)&single_w)[k]);
    }
    for (int j = 0; j < n; ++j) {
      const int k = others[j];
      if (((const int*)&s.small)[k]) {
        nest_take(&t, &s, k);
      } else {
        const global uint* c = corner + 3 * (size_t)(i + k);
        if (!nest_triangle(&t, seen[c[0]], seen[c[1]], seen[c[2]], box.left, box.bottom, box.right, box.top)) continue;
      }
      for (int ty = t.ty0; ty <= t.ty1; ++ty)
        for (int tx = t.tx0; tx <= t.tx1; ++tx) {
          const float16 w = nest_fragments(&t, plane, tx, ty, &covered);
          global float16* mine = TILE(tx, ty) + (of_a ? 1 + t.front : 0);
          *mine = max(*mine, select(-FAR, sign * w, covered));
        }
    }
  }
  NestBox touched = {INT_MAX, INT_MAX, -1, -1};
  for (int k = 0; k < 16; ++k) {
    touched.left = min(touched.left, ((int*)&left)[k]), touched.right = max(touched.right, ((int*)&right)[k]);
    touched.bottom = min(touched.bottom, ((int*)&bottom)[k]), touched.top = max(touched.top, ((int*)&top)[k]);
  }
  return touched;
}

kernel void nest_envelope(NestRaster p, const global NestView* view, const global int4* point,
                          const global uint* corner, global float16* depths, global int4* bad, global uchar* map) {
  if (get_global_id(0) % NEST_SPREAD) return;
  const int local_item = get_global_id(0) / NEST_SPREAD, item = p.first_item + local_item, tiles = p.tiles;
  if (item >= 2 * p.bands) return;
  const int second = item / p.bands;
  const int row0 = item % p.bands * p.band, row1 = min(row0 + p.band, tiles) - 1;
  const global int4* seen = point + second * (size_t)p.vertices;
  const float plane[3] = {view[second].plane[0], view[second].plane[1], view[second].plane[2]};
  global float16* depth = depths + 3 * (size_t)tiles * p.band * local_item;

  for (int ty = row0; ty <= row1; ++ty)
    for (int tx = 0; tx < tiles; ++tx) *TILE(tx, ty) = -FAR;
  const NestBox whole = {0, row0, tiles - 1, row1};
  const NestBox b_box = draw(0, p.first_b, p.triangles, seen, corner, plane, whole, row0, tiles, depth);
  for (int ty = b_box.bottom; ty <= b_box.top; ++ty)
    for (int tx = b_box.left; tx <= b_box.right; ++tx) TILE(tx, ty)[1] = TILE(tx, ty)[2] = -FAR;
  if (b_box.top >= 0) (void)draw(1, 0, p.first_b, seen, corner, plane, b_box, row0, tiles, depth);

  int4 first = {INT_MAX, NEST_GOOD, 0, 0};
  for (int ty = b_box.bottom; ty <= b_box.top; ++ty)
    for (int tx = b_box.left; tx <= b_box.right; ++tx) {
      const float16 b = TILE(tx, ty)[0], back = -TILE(tx, ty)[1], front = -TILE(tx, ty)[2];
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
