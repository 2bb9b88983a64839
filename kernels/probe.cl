// probe.cl - the two ceilings a kernel runs against: memory traffic and arithmetic.
//
// copy       in, out  real4 [n]  one read and one write of 4 reals an item
// flops      out      real  [n]  `rounds` x 64 independent chains of one fused multiply-add, kept in registers
// build      KREISEL_SINGLE      see real.h
#include "real.h"
#ifdef KREISEL_SINGLE
typedef float4 real4;
typedef float16 real16;
#else
typedef double4 real4;
typedef double16 real16;
#endif

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
