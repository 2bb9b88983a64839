// mesh_moments.cl - exact ten moments of the solid inside a closed triangle mesh, by the divergence theorem:
// each triangle stands for the signed tetrahedron to the origin, over which the ten integrals are polynomials
// of its corners. [SpinIt, eq. 4; RayRep, s. 3.4]
//
// in    vertex    real  [4*vertices] x y z 0, relative to a centre chosen by the host, to keep cancellation small
// in    corner    uint  [3*n]        where first, second, third corner of every triangle begin in `vertex`; the
//                                    padding's lie at the centre
// out   partial   accum [groups*10]  one row a work-group, order s1 sx sy sz sxy syz sxz sxx syy szz, times 6 (s1),
//                                    24 (sx sy sz) and 120
// build WG, LANES, KREISEL_SINGLE    see real.h; n is a multiple of GROUP
// sum   a block of elements a group, reduce10 at its end: fixed order, no atomics

// Vectors of at most 256 bits: longer ones are slower (docs/performance.md).
#ifdef KREISEL_SINGLE
#define MOST_LANES 8
#else
#define MOST_LANES 4
#endif
#if defined(LANES) && LANES > MOST_LANES
#undef LANES
#define LANES MOST_LANES
#endif
#include "mesh_moments_params.h"
#include "reduce10.h"

typedef JOINED(REAL, 4) real4;
typedef struct { reals x, y, z; } Points;

// Vertices of LANES triangles. Each is loaded whole, and rows of x y z 0 are transposed, which takes a third of the
// time of gathering each coordinate.
#define VERTEX(k) (*(global const real4*)(vertex + corner[k]))
#if LANES == 1
static inline Points points_at(global const real* vertex, global const uint* corner) {
  const real4 a = VERTEX(0);
  const Points p = {a.x, a.y, a.z};
  return p;
}
#else
#if LANES == 4
#define ROW(k) VERTEX(k)
#define FIRST_PAIRS(u, v) (reals)(u.s01, v.s01)
#define SECOND_PAIRS(u, v) (reals)(u.s23, v.s23)
#else
#define ROW(k) (reals)(VERTEX(k), VERTEX(k + 4))
#define FIRST_PAIRS(u, v) (reals)(u.s01, v.s01, u.s45, v.s45)
#define SECOND_PAIRS(u, v) (reals)(u.s23, v.s23, u.s67, v.s67)
#endif
static inline Points points_at(global const real* vertex, global const uint* corner) {
  const reals a = ROW(0), b = ROW(1), c = ROW(2), d = ROW(3);
  reals xz, y, xz2, y2;  // x x z z, y y 0 0, of a and b, of c and d
  xz.even = a.even, xz.odd = b.even, y.even = a.odd, y.odd = b.odd;
  xz2.even = c.even, xz2.odd = d.even, y2.even = c.odd, y2.odd = d.odd;
  const Points p = {FIRST_PAIRS(xz, xz2), FIRST_PAIRS(y, y2), SECOND_PAIRS(xz, xz2)};
  return p;
}
#endif

// Integrals over a tetrahedron of volume V with corners 0, a, b, c, s = a + b + c:
// V,  V/4 s_u,  V/20 (s_u s_v + a_u a_v + b_u b_v + c_u c_v).
#define PRODUCT(u, v) (s.u * s.v + a.u * a.v + b.u * b.v + c.u * c.v)
static inline void add_triangles(reals* sums, Points a, Points b, Points c) {
  const Points s = {a.x + b.x + c.x, a.y + b.y + c.y, a.z + b.z + c.z};
  const reals v =
      a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  sums[0] += v;
  sums[1] += v * s.x;
  sums[2] += v * s.y;
  sums[3] += v * s.z;
  sums[4] += v * PRODUCT(x, y);
  sums[5] += v * PRODUCT(y, z);
  sums[6] += v * PRODUCT(x, z);
  sums[7] += v * PRODUCT(x, x);
  sums[8] += v * PRODUCT(y, y);
  sums[9] += v * PRODUCT(z, z);
}

kernel __attribute__((reqd_work_group_size(WG, 1, 1))) void mesh_moments(MeshParams p,
                                                                         global const real* vertex,
                                                                         global const uint* corner,
                                                                         global accum* partial) {
  local real scratch[SCRATCH10];
  accums s[10];
  for (int k = 0; k < 10; ++k) s[k] = (accums)ACCUM_ZERO;
  const int end = block_end(p.block, p.n);
  for (int i = block_begin(p.block); i < end; i += KREISEL_RUN * GROUP) {
    reals run[10];
    for (int k = 0; k < 10; ++k) run[k] = 0;
    for (int j = i; j < min(i + KREISEL_RUN * GROUP, end); j += GROUP)
      add_triangles(run, points_at(vertex, corner + j), points_at(vertex, corner + p.n + j),
                    points_at(vertex, corner + 2 * (size_t)p.n + j));
    accum_add10(s, run);
  }
  reduce10(s, scratch, partial);
}
