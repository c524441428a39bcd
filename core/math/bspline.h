/* SPDX-License-Identifier: MIT */
/* B-splines of one variable: s(t) = sum_i c_i N_i(t) over knots U, nondecreasing, [n + degree + 1], clamped: the first
   and the last degree + 1 knots are equal. Coefficients are vectors of width numbers, [n][width]. [Piegl Tiller 1997] */
#ifndef FS_MATH_BSPLINE_H
#define FS_MATH_BSPLINE_H

#include "base/base.h"

enum { FS_KNOTS_MAX_DEGREE = 15 };

/* Knots nearer than this times the length of the domain are the same knot. */
#define FS_KNOT_TOLERANCE 1e-9

typedef struct fs_knots {
  int32_t degree, n; /* n coefficients: n + degree + 1 knots */
  const double *knot;
} fs_knots;

/* Everything said above, degree >= 0, at most degree equal knots inside (so that the spline is continuous), all finite.
   FS_ERR_ARGUMENT names the knot, its value and what, for example "the u knots of patch 'q'". */
fs_status fs_knots_check(fs_context *ctx, const char *what, const fs_knots *knots);

/* The s with U_s <= t < U_(s+1), the last nonempty span where t is at the end or beyond. */
int32_t fs_knots_span(const fs_knots *knots, double t);

/* value[degree + 1] = order-th derivatives at t of N_(span-degree) .. N_span. */
void fs_knots_basis(const fs_knots *knots, int32_t span, double t, int32_t order, double *value);

/* value[width] = order-th derivative of the spline at t, from the left at the end and from the right elsewhere. */
void fs_bspline_evaluate(const fs_knots *knots, int32_t width, const double *c, double t, int32_t order, double *value);

/* Greville abscissa (U_(i+1) + … + U_(i+degree)) / degree, degree >= 1. */
double fs_knots_greville(const fs_knots *knots, int32_t i);

int32_t fs_knots_multiplicity(const fs_knots *knots, double t);

/* refined[to->n][width] = coefficients of the same spline over finer knots of the same degree, which hold all knots of
   from, at least as often (Boehm's insertion of one knot after the other). */
fs_status fs_bspline_refine(fs_context *ctx, const fs_knots *from, int32_t width, const double *c, const fs_knots *to,
                            double *refined);

/* Every value of a or b with the larger of its multiplicities. Both have the same degree and domain.
   joined[a->n + b->n] takes them (room for all); returns their number n + degree + 1. */
int32_t fs_knots_unite(const fs_knots *a, const fs_knots *b, double *joined);

/* c[n][width], in: values at the Greville abscissae; out: the coefficients of the spline with those values. Elimination
   in the band without pivoting, which is stable: the matrix is totally positive [de Boor Pinkus 1977]. */
fs_status fs_bspline_interpolate(fs_context *ctx, const fs_knots *knots, int32_t width, double *c);

int32_t fs_knots_n_spans(const fs_knots *knots); /* those that are not empty */

/* bezier[n_spans][degree + 1][width] and, where not NULL, ends[n_spans + 1]: the Bezier form of every nonempty span. */
fs_status fs_bspline_bezier(fs_context *ctx, const fs_knots *knots, int32_t width, const double *c, double *bezier,
                            double *ends);

#endif
