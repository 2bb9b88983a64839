// probe.cl - the ceilings a kernel runs against: memory traffic and arithmetic.
//
// read       in       real  [n]  a sum, so that nothing is left out; a block of elements a group, n a multiple of
//            out      real  [groups*GROUP]                                     4 GROUP, as is the block
// copy       in, out  real4 [n]  one read and one write of 4 reals an item
// flops      out      real  [n]  `rounds` x 64 independent chains of one fused multiply-add, kept in registers
// build      WG, LANES, KREISEL_SINGLE   see real.h
#include "real.h"
#ifdef KREISEL_SINGLE
typedef float4 real4;
typedef float16 real16;
#else
typedef double4 real4;
typedef double16 real16;
#endif

kernel __attribute__((reqd_work_group_size(WG, 1, 1))) void probe_read(int block, int n, global const real* in,
                                                                       global real* out) {
  const int lane = (int)get_local_id(0) * LANES;
  const int begin = (int)get_group_id(0) * block, end = min(begin + block, n);
  reals a = 0, b = 0, c = 0, d = 0;
  for (int i = begin + lane; i < end; i += 4 * GROUP) {
    a += LOAD(i, in);
    b += LOAD(i + GROUP, in);
    c += LOAD(i + 2 * GROUP, in);
    d += LOAD(i + 3 * GROUP, in);
  }
  STORE((a + b) + (c + d), (int)get_group_id(0) * GROUP + lane, out);
}

kernel void probe_copy(global const real4* in, global real4* out) {
  const size_t i = get_global_id(0);
  out[i] = in[i];
}

kernel void probe_flops(int rounds, real a, real b, global real* out) {
  const size_t i = get_global_id(0);
  // Four 16-wide chains hide the latency of a fused multiply-add on CPUs; a GPU hides it by its other work-items.
  const real16 lane = (real16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  real16 x = lane + (real)i, y = x + (real)0.25, u = x + (real)0.5, v = x + (real)0.75;
  for (int r = 0; r < rounds; ++r) {
    x = fma(x, (real16)(a), (real16)(b));
    y = fma(y, (real16)(a), (real16)(b));
    u = fma(u, (real16)(a), (real16)(b));
    v = fma(v, (real16)(a), (real16)(b));
  }
  const real16 z = (x + y) + (u + v);
  out[i] = z.s0 + z.s1 + z.s2 + z.s3 + z.s4 + z.s5 + z.s6 + z.s7 + z.s8 + z.s9 + z.sa + z.sb + z.sc + z.sd + z.se + z.sf;
}
