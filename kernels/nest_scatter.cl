// nest_scatter.cl - the envelopes of nest_envelope.cl, a triangle of a view an item and joined by atomics: for devices
// that run thousands of items at once. [Nest, s. 5] (nest_raster.h)
//
// in    view         NestView [2]
//       point        int4  [2*vertices]   nest_project
//       corner       uint  [3*triangles]  vertices, A's triangles then B's
// i/o   b            uint  [2*width^2]    keys of max w of B; starts with 0
//       back, front  uint  [2*width^2]    keys of min w of back- and of front-facing A; start with all bits set
//       first        int   [2]            of each half its first bad pixel (y * width + x); starts with INT_MAX
// out   map          uchar [2*width^2]    why each pixel is bad
// The order of triangles does not show, for atomic maxima and minima have none.
#include "nest_raster.h"

kernel void nest_scatter(NestRaster p, const global NestView* view, const global int4* point, const global uint* corner,
                         volatile global uint* b, volatile global uint* back, volatile global uint* front) {
  NEST_EACH_FRAGMENT(if (i >= p.first_b) atomic_max(b + pixel, key);
                     else atomic_min((t.front ? front : back) + pixel, key);)
}

kernel void nest_scatter_rules(NestRaster p, const global uint* b, const global uint* back, const global uint* front,
                               volatile global int* first, global uchar* map) {
  const int pixels = p.width * p.width, id = get_global_id(0), second = id >= pixels;
  if (id >= 2 * pixels) return;
  const int fault = nest_fault(b[id] == 0 ? -INFINITY : nest_depth(b[id]),
                               back[id] == UINT_MAX ? INFINITY : nest_depth(back[id]),
                               front[id] == UINT_MAX ? INFINITY : nest_depth(front[id]));
  map[id] = fault;
  if (fault != NEST_GOOD) atomic_min(first + second, id - second * pixels);
}
