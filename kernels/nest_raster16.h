/* nest_raster16.h - what nest_raster.h says of one triangle, of 16 at a time, to the last bit: most triangles are smaller
 * than a pixel, and finding that out one by one costs more than drawing the others. */
#ifndef KREISEL_NEST_RASTER16_H
#define KREISEL_NEST_RASTER16_H
#include "nest_raster.h"

/* Of triangles that span more steps along x or y, products do not fit into 32 bits: they are left to nest_triangle. */
#define NEST_SMALL (64 * NEST_STEPS)

typedef struct {
  int16 tx0, ty0, tx1, ty1, px, py; /* as in NestTriangle; px, py the first pixel of the box */
  int16 x0, y0, e[3], dx[3], dy[3]; /* dx, dy: along its edges, turned so that inside is >= 0 */
  float16 w, gx, gy, least, most;
  int16 live, small, single, front; /* masks; live: nest_triangle would not say 0. If not small only live holds */
} NestTriangles;

/* Where 16 points lie: x, y in steps, w, and how far beyond the plane; every third of `corner` says which. */
static inline void nest_points(const global int4* seen, const global uint* corner, int16* x, int16* y, float16* w,
                               float16* beyond) {
#define AT(i) seen[corner[3 * (i)]]
  const int16 a = (int16)(AT(0), AT(1), AT(2), AT(3)), b = (int16)(AT(4), AT(5), AT(6), AT(7));
  const int16 c = (int16)(AT(8), AT(9), AT(10), AT(11)), d = (int16)(AT(12), AT(13), AT(14), AT(15));
#undef AT
  *x = (int16)(a.s048c, b.s048c, c.s048c, d.s048c);
  *y = (int16)(a.s159d, b.s159d, c.s159d, d.s159d);
  *w = as_float16((int16)(a.s26ae, b.s26ae, c.s26ae, d.s26ae));
  *beyond = as_float16((int16)(a.s37bf, b.s37bf, c.s37bf, d.s37bf));
}

/* Without a promise about overflow: of triangles that are not small it does, and is not looked at. */
static inline int16 nest_cross(int16 ax, int16 ay, int16 bx, int16 by) {
  return as_int16(as_uint16(ax) * as_uint16(by) - as_uint16(ay) * as_uint16(bx));
}

/* Returns 0 if none of the first `count` is live. Reads the corners of 16, whatever the count. */
static inline int nest_triangles(NestTriangles* t, const global int4* seen, const global uint* corner, int count,
                                 int column0, int row0, int column1, int row1) {
  const int16 lane = (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  int16 x[3], y[3];
  float16 w[3], beyond[3];
  for (int k = 0; k < 3; ++k) nest_points(seen, corner + k, &x[k], &y[k], &w[k], &beyond[k]);
  int16 live = (lane < count) & ((beyond[0] > 0) | (beyond[1] > 0) | (beyond[2] > 0));
  if (!any(live)) return 0;
  const int half_step = NEST_STEPS / 2;
  const int16 left = min(min(x[0], x[1]), x[2]), right = max(max(x[0], x[1]), x[2]);
  const int16 low = min(min(y[0], y[1]), y[2]), high = max(max(y[0], y[1]), y[2]);
  const int16 px0 = (left + half_step - 1) >> 8, px1 = (right - half_step) >> 8;
  const int16 py0 = (low + half_step - 1) >> 8, py1 = (high - half_step) >> 8;
  t->tx0 = max(px0 >> 2, column0), t->tx1 = min(px1 >> 2, column1);
  t->ty0 = max(py0 >> 2, row0), t->ty1 = min(py1 >> 2, row1);
  live &= (px0 <= px1) & (py0 <= py1) & (t->tx0 <= t->tx1) & (t->ty0 <= t->ty1);
  if (!any(live)) return 0;
  t->px = px0, t->py = py0;
  t->small = (right - left < NEST_SMALL) & (high - low < NEST_SMALL);
  t->single = (px0 == px1) & (py0 == py1);
  const int16 area = nest_cross(x[1] - x[0], y[1] - y[0], x[2] - x[0], y[2] - y[0]);
  t->live = live & (~t->small | (area != 0));
  t->front = area < 0;
  const float16 w1 = w[1] - w[0], w2 = w[2] - w[0], steps = (float16)NEST_STEPS / convert_float16(area);
  t->x0 = x[0], t->y0 = y[0], t->w = w[0];
  t->gx = (w1 * convert_float16(y[2] - y[0]) - w2 * convert_float16(y[1] - y[0])) * steps;
  t->gy = (w2 * convert_float16(x[1] - x[0]) - w1 * convert_float16(x[2] - x[0])) * steps;
  t->least = min(min(w[0], w[1]), w[2]);
  t->most = max(max(w[0], w[1]), w[2]);
  const int16 cx = t->tx0 * (4 * NEST_STEPS) + half_step, cy = t->ty0 * (4 * NEST_STEPS) + half_step;
  for (int k = 0; k < 3; ++k) {
    const int16 x1 = x[k == 2 ? 0 : k + 1], y1 = y[k == 2 ? 0 : k + 1];
    t->dx[k] = ((x1 - x[k]) ^ t->front) - t->front;
    t->dy[k] = ((y1 - y[k]) ^ t->front) - t->front;
    t->e[k] = nest_cross(t->dx[k], t->dy[k], cx - x[k], cy - y[k]);
  }
  return 1;
}

/* One of them, live and small. */
static inline void nest_take(NestTriangle* t, const NestTriangles* s, int lane) {
#define OF(v) (((const int*)&(v))[lane])
#define OF_FLOAT(v) (((const float*)&(v))[lane])
  t->tx0 = OF(s->tx0), t->ty0 = OF(s->ty0), t->tx1 = OF(s->tx1), t->ty1 = OF(s->ty1);
  t->x0 = OF(s->x0), t->y0 = OF(s->y0);
  for (int k = 0; k < 3; ++k) {
    const int dx = OF(s->dx[k]), dy = OF(s->dy[k]);
    t->e[k] = OF(s->e[k]);
    t->ex[k] = -(long)dy * (4 * NEST_STEPS);
    t->ey[k] = (long)dx * (4 * NEST_STEPS);
    t->ax[k] = -(float)dy * NEST_STEPS;
    t->ay[k] = (float)dx * NEST_STEPS;
  }
  t->w = OF_FLOAT(s->w), t->gx = OF_FLOAT(s->gx), t->gy = OF_FLOAT(s->gy);
  t->least = OF_FLOAT(s->least), t->most = OF_FLOAT(s->most);
  t->front = -OF(s->front);
#undef OF
#undef OF_FLOAT
}

/* Depths in the first pixel of each one's box, for those that are single; `covered` is -1 where it has a fragment. */
static inline float16 nest_single_fragments(const NestTriangles* t, const float plane[3], int16* covered) {
  const int16 lx = t->px & 3, ly = t->py & 3;
  int16 in = t->live & t->single & t->small;
  for (int k = 0; k < 3; ++k) in &= t->e[k] + nest_cross(t->dx[k], t->dy[k], lx * NEST_STEPS, ly * NEST_STEPS) >= 0;
  const float16 fx = convert_float16(lx), fy = convert_float16(ly);
  const float16 x = convert_float16(4 * t->tx0) + 0.5f, y = convert_float16(4 * t->ty0) + 0.5f;
  const float16 base = fma(t->gx, x - convert_float16(t->x0) * (1.0f / NEST_STEPS),
                           fma(t->gy, y - convert_float16(t->y0) * (1.0f / NEST_STEPS), t->w));
  const float16 w = clamp(fma(t->gx, fx, fma(t->gy, fy, base)), t->least, t->most);
  const float16 p1 = plane[1], p2 = plane[2];
  const float16 cut = fma(p1, x, fma(p2, y, (float16)plane[0]));
  *covered = in & (w > fma(p1, fx, fma(p2, fy, cut)));
  return w;
}
#endif
