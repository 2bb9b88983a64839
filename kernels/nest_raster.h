/* nest_raster.h - fragments of one triangle in one view, for the envelopes and for peeling alike: the same numbers to
 * the last bit.
 *
 *       w (depth, along the removal direction a of this half)
 *       ^            ____                     A leaves upwards, along a, away from the camera.
 *       |      .---''    ``---.    A, back    The camera is on the cut's side and looks along +a, so w grows with
 *       |     /    .-----.     \              removal; of both meshes only w > w_plane is kept.
 *       |    |    /   B   \     |             A is front-facing where its outward normal looks at the camera, N.a < 0:
 *       |    |   |         |    |             the lower side of a ledge. Inside A the first surface along a is
 *   ----+====|===|=========|====|==== P       back-facing.
 *       |    '   '         '    '             A pixel is bad when
 *       |                                       1  a fragment of A comes before one of B   (A sweeps through B)
 *     camera                                    2  one of B comes before the background    (B sticks out)
 *                                               3  one of B comes before a front-facing A  (B sticks out)
 *   which is (docs/nesting.md)
 *     good  <=>  no B,  or  max w_B < min w_A  and  the nearest A is back-facing.
 *   At equal depths A counts as before B, and front-facing as before back-facing.
 */
#ifndef KREISEL_NEST_RASTER_H
#define KREISEL_NEST_RASTER_H
#include "nest_raster_params.h"
#pragma OPENCL FP_CONTRACT OFF

/* Lanes of a 4 x 4 tile, x fastest. */
#define LANE_X (float16)(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3)
#define LANE_Y (float16)(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3)

typedef struct {
  int tx0, ty0, tx1, ty1; /* tiles it may cover, inclusive */
  int x0, y0;             /* first corner, in steps */
  long e[3];              /* edge functions at the centre of pixel 0 of tile (tx0, ty0): >= 0 inside */
  long ex[3], ey[3];      /* their steps from tile to tile */
  float ax[3], ay[3];     /* and from pixel to pixel */
  float w, gx, gy;        /* depth at the first corner, and its slopes a pixel */
  float least, most;      /* of its corners' depths */
  int front;
} NestTriangle;

/* 0 when it has no pixel's centre beyond the plane, or is seen edge-on. `corner` has x, y in steps, w, and how far it is
 * beyond the plane; tiles are limited to rows [row0, row1] and columns [column0, column1] of tiles. */
static inline int nest_triangle(NestTriangle* t, int4 p, int4 q, int4 r, int column0, int row0, int column1,
                                int row1) {
  if (as_float(p.w) <= 0 && as_float(q.w) <= 0 && as_float(r.w) <= 0) return 0;
  const int half_step = NEST_STEPS / 2;
  /* First and last pixels whose centres lie in the box. */
  const int px0 = (min(min(p.x, q.x), r.x) + half_step - 1) >> 8, px1 = (max(max(p.x, q.x), r.x) - half_step) >> 8;
  const int py0 = (min(min(p.y, q.y), r.y) + half_step - 1) >> 8, py1 = (max(max(p.y, q.y), r.y) - half_step) >> 8;
  if (px0 > px1 || py0 > py1) return 0;
  t->tx0 = max(px0 >> 2, column0), t->tx1 = min(px1 >> 2, column1);
  t->ty0 = max(py0 >> 2, row0), t->ty1 = min(py1 >> 2, row1);
  if (t->tx0 > t->tx1 || t->ty0 > t->ty1) return 0;
  const long area = (long)(q.x - p.x) * (r.y - p.y) - (long)(r.x - p.x) * (q.y - p.y);
  if (area == 0) return 0;
  t->front = area < 0;
  const float w0 = as_float(p.z), w1 = as_float(q.z) - w0, w2 = as_float(r.z) - w0;
  const float steps = (float)NEST_STEPS / (float)area;
  t->x0 = p.x, t->y0 = p.y;
  t->w = w0;
  t->gx = (w1 * (float)(r.y - p.y) - w2 * (float)(q.y - p.y)) * steps;
  t->gy = (w2 * (float)(q.x - p.x) - w1 * (float)(r.x - p.x)) * steps;
  t->least = min(min(w0, as_float(q.z)), as_float(r.z));
  t->most = max(max(w0, as_float(q.z)), as_float(r.z));
  const int2 corner[3] = {p.xy, q.xy, r.xy};
  const int sign = t->front ? -1 : 1;
  const int cx = t->tx0 * 4 * NEST_STEPS + half_step, cy = t->ty0 * 4 * NEST_STEPS + half_step;
  for (int k = 0; k < 3; ++k) {
    const int2 from = corner[k], to = corner[k == 2 ? 0 : k + 1];
    const int dx = sign * (to.x - from.x), dy = sign * (to.y - from.y);
    t->e[k] = (long)dx * (cy - from.y) - (long)dy * (cx - from.x);
    t->ex[k] = -(long)dy * (4 * NEST_STEPS);
    t->ey[k] = (long)dx * (4 * NEST_STEPS);
    t->ax[k] = -(float)dy * NEST_STEPS;
    t->ay[k] = (float)dx * NEST_STEPS;
  }
  return 1;
}

/* Depths of its fragments in a tile; `covered` has -1 where there is one, 0 elsewhere. Two triangles with an edge in
 * common see opposite edge functions there, so a centre on it is covered by both, whatever the rounding. */
static inline float16 nest_fragments(const NestTriangle* t, const float plane[3], int tx, int ty, int16* covered) {
  int16 in = (int16)(-1);
  for (int k = 0; k < 3; ++k) {
    const float e = (float)(t->e[k] + t->ex[k] * (tx - t->tx0) + t->ey[k] * (ty - t->ty0));
    in &= fma((float16)t->ax[k], LANE_X, fma((float16)t->ay[k], LANE_Y, (float16)e)) >= (float16)0;
  }
  const float x = 4 * tx + 0.5f, y = 4 * ty + 0.5f;
  const float base = fma(t->gx, x - t->x0 * (1.0f / NEST_STEPS), fma(t->gy, y - t->y0 * (1.0f / NEST_STEPS), t->w));
  float16 w = fma((float16)t->gx, LANE_X, fma((float16)t->gy, LANE_Y, (float16)base));
  w = clamp(w, (float16)t->least, (float16)t->most);
  const float cut = fma(plane[1], x, fma(plane[2], y, plane[0]));
  *covered = in & (w > fma((float16)plane[1], LANE_X, fma((float16)plane[2], LANE_Y, (float16)cut)));
  return w;
}

/* Depths as keys that sort like them, for atomic minima and maxima; 0 and all bits set are no depth's. */
static inline uint nest_key(float w) {
  const uint bits = as_uint(w);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}
static inline float nest_depth(uint key) { return as_float(key & 0x80000000u ? key & 0x7fffffffu : ~key); }

/* BODY for each fragment of the triangle of this item, one of 2 * triangles: `i` its triangle, `t` what it has of it,
 * `pixel` where in both views' pixels, `key` of its depth. */
#define NEST_EACH_FRAGMENT(BODY)                                                                      \
  const int id = get_global_id(0), second = id >= p.triangles, i = id - second * p.triangles;         \
  if (id >= 2 * p.triangles) return;                                                                  \
  const global int4* seen = point + second * (size_t)p.vertices;                                      \
  const global uint* c = corner + 3 * (size_t)i;                                                      \
  NestTriangle t;                                                                                     \
  if (!nest_triangle(&t, seen[c[0]], seen[c[1]], seen[c[2]], 0, 0, p.tiles - 1, p.tiles - 1)) return; \
  const float plane[3] = {view[second].plane[0], view[second].plane[1], view[second].plane[2]};       \
  for (int ty = t.ty0; ty <= t.ty1; ++ty)                                                             \
    for (int tx = t.tx0; tx <= t.tx1; ++tx) {                                                         \
      int16 covered;                                                                                  \
      const float16 w = nest_fragments(&t, plane, tx, ty, &covered);                                  \
      for (int k = 0; k < 16; ++k) {                                                                  \
        const int x = 4 * tx + (k & 3), y = 4 * ty + (k >> 2);                                        \
        if (!((int*)&covered)[k] || x >= p.width || y >= p.width) continue;                           \
        const size_t pixel = second * (size_t)p.width * p.width + (size_t)y * p.width + x;            \
        const uint key = nest_key(((float*)&w)[k]);                                                   \
        BODY                                                                                          \
      }                                                                                               \
    }

/* Why a pixel is bad, of the farthest B there and the nearest A; -INFINITY and INFINITY where there is none. */
static inline int nest_fault(float b, float back, float front) {
  if (b == -INFINITY || (b < back && back < front)) return NEST_GOOD;
  if (back == INFINITY && front == INFINITY) return NEST_UNCOVERED;
  return b < back && b < front ? NEST_STICKS_OUT : NEST_SWEPT;
}
#endif
