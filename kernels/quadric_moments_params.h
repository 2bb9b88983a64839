/* quadric_moments_params.h - a bundle of vertical intervals and the quadric that clips them. */
#ifndef KREISEL_QUADRIC_MOMENTS_PARAMS_H
#define KREISEL_QUADRIC_MOMENTS_PARAMS_H
#include "params.h"
PARAMS_BEGIN(QuadricParams)
  real ox, oy;  /* centre of column (0,0), body units */
  real h;       /* spacing: an interval stands for an h x h column */
  real q[10];   /* coefficients of 1 x y z xy yz xz xx yy zz */
  real pad_;
  int n;        /* intervals, padded */
  int block;    /* intervals a work-group sums */
PARAMS_END(QuadricParams)
#endif
