/* SPDX-License-Identifier: MIT */
/* Filling the gap between two B-spline patches. */
#ifndef FAIRSURF_CONSTRUCT_GAP_H
#define FAIRSURF_CONSTRUCT_GAP_H

#include <fairsurf/surface_splines.h>

#ifdef __cplusplus
extern "C" {
#endif

/* With q on [c, d] x [a, b] and r on [e, f] x [a, b], cubic by v, the filling s on [0, 1] x [a, b] runs from s(0, v) = q(d, v)
   to s(1, v) = r(e, v) with
     s_u(0, v) = c1 q_u,  s_u(1, v) = g1 r_u,  and for order 2  s_uu(0, v) = c1^2 q_uu,  s_uu(1, v) = g1^2 r_uu,
     c1 = factor[0] |q - r| / |q_u|,  g1 = factor[1] |q - r| / |r_u|,
   so that it joins both with one tangent plane (order 1) or one curvature (order 2). Neither c1 nor g1 is a spline:
   - is_exact: they are replaced by splines of degree scalar_degree. The tangent planes and curvatures agree exactly, the
     degree by v is 3 + order scalar_degree, that by u is 3 or 5.
   - else: the vectors c1 q_u, … are replaced by cubic splines. The degree is (3, 3) or (5, 3); normals agree within angle.
   The knots by v are those of q and of r, and more: every span of these is cut into n_parts equal parts; with n_parts 0, spans
   are halved until the angle is met (or, is_exact, until c1 and g1 stay positive). */
typedef struct fs_gap_options {
  int32_t order; /* 1 or 2; 0: 1 */
  bool is_exact;
  int32_t scalar_degree; /* 2 or 3; 0: 3 */
  double angle;          /* radians, largest between normals at the seams; 0: 1e-4 */
  int32_t n_parts;
  double factor[2]; /* for the side of q and that of r; 0: 1 */
} fs_gap_options;

typedef struct fs_gap_report {
  int32_t n_spans;  /* of the filling by v */
  double position;  /* largest distance between the filling and q or r along the seams */
  double angle;     /* largest between normals there */
  double curvature; /* largest component of the difference of curvature tensors there */
  double length;    /* largest of | |s_u| / (c1 |q_u|) - 1 | and the same for r */
} fs_gap_report;

/* FS_ERR_ARGUMENT: a patch that is not cubic by v, different v domains, and q_u that points away from r at most points of
   its seam (turn the patch round: u must rise from q over the gap to r), or r_u from q. FS_ERR_NUMERIC: seams that touch, a
   vanishing q_u or r_u, c1 or g1 that cannot be kept positive, an angle that is not met with 4096 spans. */
FS_API fs_status fs_gap_fill(fs_context *ctx, const fs_spline *q, const fs_spline *r, const fs_gap_options *options,
                             fs_spline **filling, fs_gap_report *report);

/* q, the filling and r as one surface without T-junctions: knots of the filling are inserted into q and r. */
FS_API fs_status fs_gap_surface(fs_context *ctx, const fs_spline *q, const fs_spline *filling, const fs_spline *r,
                                fs_surface **surface);

#ifdef __cplusplus
}
#endif
#endif
