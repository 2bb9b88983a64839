/* voxel_moments_params.h - a sparse set of cubic voxels on a uniform grid. */
#ifndef KREISEL_VOXEL_MOMENTS_PARAMS_H
#define KREISEL_VOXEL_MOMENTS_PARAMS_H
#include "params.h"
PARAMS_BEGIN(VoxelParams)
  real ox, oy, oz;  /* centre of cell (0,0,0), body units */
  real h;           /* edge of a cell */
  int n;            /* voxels, padded */
  int rows;         /* weight rows of the pull-back */
  int block;        /* voxels a work-group sums */
  int pad_;
PARAMS_END(VoxelParams)
#endif
