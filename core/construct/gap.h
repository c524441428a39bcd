/* SPDX-License-Identifier: MIT */
/* What the files of gap filling share. */
#ifndef FS_CONSTRUCT_GAP_H
#define FS_CONSTRUCT_GAP_H

#include <fairsurf/construct_gap.h>
#include "base/base.h"
#include "math/bspline.h"
#include "surface/spline.h"

enum { FS_GAP_MAX_SPANS = 4096, FS_GAP_SAMPLES = 17 }; /* per span */

/* A seam: derivatives by u of a patch at one end, as splines of v with the patch's knots. */
typedef struct fs_gap_seam {
  const fs_spline *patch;
  double u, sign, factor; /* sign: 1 at the end of q, -1 at the start of r, towards the other patch */
  fs_knots knots;
  double *c[3]; /* [n][3] for the derivatives of order 0, 1, 2 */
} fs_gap_seam;

/* [0] is q, [1] is r. */
typedef struct fs_gap {
  fs_gap_seam seam[2];
  fs_gap_options options; /* with no zeros left but n_parts */
} fs_gap;

fs_status fs_gap_open(fs_context *ctx, const fs_spline *q, const fs_spline *r, const fs_gap_options *options,
                      fs_gap *gap);
void fs_gap_close(fs_context *ctx, fs_gap *gap);

/* order-th derivative by u at the seam. */
fs_vec3 fs_gap_seam_point(const fs_gap_seam *seam, double v, int32_t order);

/* c1 or g1 at v, with the factor of the side. */
double fs_gap_scale(const fs_gap *gap, int side, double v);

/* The filling over the given knots of degree 3 by v, which hold those of both seams. */
fs_status fs_gap_approximate(fs_context *ctx, const fs_gap *gap, const fs_knots *knots, fs_spline **filling);
/* is_positive: whether c1 and g1 stayed so; else filling is not made. */
fs_status fs_gap_multiply(fs_context *ctx, const fs_gap *gap, const fs_knots *knots, bool *is_positive,
                          fs_spline **filling);

/* Differences at FS_GAP_SAMPLES points per span of the filling, ends included. span_angle[n_spans]: the largest angle in
   each; may be NULL. FS_ERR_NUMERIC where a patch has no normal. */
fs_status fs_gap_measure(fs_context *ctx, const fs_gap *gap, const fs_spline *filling, double *span_angle,
                         fs_gap_report *report);

#endif
