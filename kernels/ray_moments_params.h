/* ray_moments_params.h - a bundle of parallel rays on an xy grid. */
#ifndef KREISEL_RAY_MOMENTS_PARAMS_H
#define KREISEL_RAY_MOMENTS_PARAMS_H
#include "params.h"
PARAMS_BEGIN(RayParams)
  real ox, oy;  /* centre of column (0,0), body units */
  real h;       /* spacing: a ray stands for an h x h column */
  real unit;    /* length of one unit of z0 and z1, body units */
  int n;        /* rays, padded */
  int rows;     /* weight rows of the pull-back */
  int block;    /* rays a work-group sums */
  int pad_;
PARAMS_END(RayParams)
#endif
