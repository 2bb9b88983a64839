/* nest_raster_params.h - two orthographic views of the outer mesh A and the inner mesh B, one a half. */
#ifndef KREISEL_NEST_RASTER_PARAMS_H
#define KREISEL_NEST_RASTER_PARAMS_H
/* Floats and 32-bit words on every device: pixels are whole numbers, depths need no more. */

/* Steps of a pixel to which vertices are rounded: edges are then exact in 64-bit integers, so that a pixel's centre
 * on an edge belongs to both triangles and a closed surface has no cracks. */
#define NEST_STEPS 256

/* Work-items of nest_envelope of which one has work. PoCL hands half of all groups to the first thread that asks, so a
 * few long ones would run one after the other. */
#define NEST_SPREAD 32

/* Why a pixel is bad: nest::Fault on the host. */
#define NEST_GOOD 0
#define NEST_OUTSIDE 1
#define NEST_SWEPT 2
#define NEST_UNCOVERED 3
#define NEST_STICKS_OUT 4

typedef struct {
  float a[12];    /* rows: pixel x, pixel y, depth w, of (x, y, z, 1) of A */
  float b[12];    /* the same of B, its pose included */
  float plane[3]; /* depth of the cut: [0] + [1] x + [2] y, x and y in pixels */
  float pad_;
} NestView;

typedef struct {
  int width;     /* pixels along either side */
  int tiles;     /* 4 x 4 tiles along either side */
  int vertices;  /* of A and B together, each padded to whole groups of 16 */
  int inner;     /* the first vertex of B */
  int triangles; /* of A and B together */
  int first_b;   /* the first triangle of B */
  int band;      /* rows of tiles a work-item of nest_envelope takes */
  int bands;     /* of a view */
  int map;       /* whether to write a byte for every pixel */
  int first_item; /* of this launch of nest_envelope */
} NestRaster;
#endif
