// nest_peel.cl - feasibility by depth peeling, as published: layer by layer, the nearest fragment behind the last
// layer's, and the rules between two layers. [Nest, s. 5] (nest_raster.h)
//
// in    view      NestView [2]
//       point     int4  [2*vertices]   nest_project
//       corner    uint  [3*triangles]  vertices, A's triangles then B's
// i/o   near, far uint  [2*width^2]    depths of the last and of this layer, as keys that sort like them; near starts
//                                      with 0, far has all bits set before a layer, and after it where nothing is left
//       was, is   uint  [2*width^2]    what the fragments of the last and of this layer are of: bits of PEEL_...; 0 is
//                                      the background
//       state     int   [4]            first bad pixel of half 0, of half 1 (y * width + x, or INT_MAX), whether this
//                                      layer drew anything
//       map       uchar [2*width^2]    why each pixel is bad: its first fault
// A layer is three launches: depths by atomic minima, then colours, then the rules. Fragments at one depth are one
// layer: their colours are joined, A counts as before B, front-facing as before back-facing.
#include "nest_raster.h"

#define PEEL_BACK 1
#define PEEL_FRONT 2
#define PEEL_B 4

kernel void nest_peel_depth(NestRaster p, const global NestView* view, const global int4* point,
                            const global uint* corner, const global uint* near, volatile global uint* far) {
  NEST_EACH_FRAGMENT(if (key > near[pixel]) atomic_min(far + pixel, key);)
}

kernel void nest_peel_colour(NestRaster p, const global NestView* view, const global int4* point,
                             const global uint* corner, const global uint* far, volatile global uint* is) {
  NEST_EACH_FRAGMENT(if (key == far[pixel])
                        atomic_or(is + pixel, i >= p.first_b ? PEEL_B : t.front ? PEEL_FRONT : PEEL_BACK);)
}

// The rules between the last layer and this.
kernel void nest_peel_rules(NestRaster p, const global uint* was, const global uint* is, volatile global int* state,
                            global uchar* map) {
  const int pixels = p.width * p.width, id = get_global_id(0), second = id >= pixels;
  if (id >= 2 * pixels) return;
  const uint before = was[id], here = is[id];
  if (here) state[2] = 1;
  int fault = NEST_GOOD;
  if ((here & PEEL_B) && ((before | here) & (PEEL_BACK | PEEL_FRONT)))
    fault = NEST_SWEPT;
  else if ((before & PEEL_B) && here == 0)
    fault = NEST_UNCOVERED;
  else if ((before & PEEL_B) && (here & PEEL_FRONT))
    fault = NEST_STICKS_OUT;
  if (fault == NEST_GOOD) return;
  atomic_min(state + second, id - second * pixels);
  if (map[id] == NEST_GOOD) map[id] = fault;
}
