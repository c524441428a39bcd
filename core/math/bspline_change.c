/* SPDX-License-Identifier: MIT */
/* Single role: the same B-spline over other knots, as Bezier pieces, and from its values.

   Boehm: inserting x into the span s, U_s <= x < U_(s+1), gives
     d_i = a c_i + (1 - a) c_(i-1),  a = (x - U_i) / (U_(i+p) - U_i)  for s - p < i <= s,
   and leaves the coefficients before and after as they are [Boehm 1980; Piegl Tiller 1997, 5.2]. */
#include "math/bspline.h"

#include <math.h>
#include <string.h>

/* Inserts x into knots U[n + p + 1] and coefficients c[n][width], in place; there is room for one more of each. */
static void insert(int32_t p, int32_t n, double *U, int32_t width, double *c, double x) {
  const fs_knots k = {p, n, U};
  int32_t s = fs_knots_span(&k, x);
  size_t w = (size_t)width;
  memmove(c + (size_t)(s + 1) * w, c + (size_t)s * w, (size_t)(n - s) * w * sizeof *c);
  for (int32_t i = s; i > s - p; i--) {
    double a = (x - U[i]) / (U[i + p] - U[i]);
    double *now = c + (size_t)i * w;
    const double *before = now - w;
    for (size_t j = 0; j < w; j++) now[j] = a * now[j] + (1 - a) * before[j];
  }
  memmove(U + s + 2, U + s + 1, (size_t)(n + p - s) * sizeof *U);
  U[s + 1] = x;
}

fs_status fs_bspline_refine(fs_context *ctx, const fs_knots *from, int32_t width, const double *c, const fs_knots *to,
                            double *refined) {
  fs_status status = FS_OK;
  int32_t p = from->degree, n = from->n;
  double *U = NULL, *points = NULL;
  size_t w = (size_t)width;
  if (to->n < n || to->degree != p)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the finer knots do not hold all of the coarser ones");
  FS_ALLOC(ctx, U, to->n + p + 1);
  FS_ALLOC(ctx, points, (size_t)to->n * w);
  memcpy(U, from->knot, (size_t)(n + p + 1) * sizeof *U);
  memcpy(points, c, (size_t)n * w * sizeof *c);
  for (int32_t i = p + 1; i < to->n && n < to->n; i++) {
    fs_knots now = {p, n, U};
    double x = to->knot[i];
    if (fs_knots_multiplicity(&now, x) >= fs_knots_multiplicity(to, x)) continue;
    insert(p, n++, U, width, points, x);
  }
  if (n != to->n) {
    status = fs_fail(ctx, FS_ERR_ARGUMENT, "the finer knots do not hold all of the coarser ones");
    goto done;
  }
  memcpy(refined, points, (size_t)to->n * w * sizeof *c);
done:
  fs_release(ctx, U);
  fs_release(ctx, points);
  return status;
}

fs_status fs_bspline_bezier(fs_context *ctx, const fs_knots *k, int32_t width, const double *c, double *bezier,
                            double *ends) {
  fs_status status = FS_OK;
  int32_t p = k->degree, n_spans = fs_knots_n_spans(k), n = p * n_spans + 1, used = 0, piece = 0;
  size_t w = (size_t)width;
  double *U = NULL, *points = NULL;
  fs_knots full = {p, n, NULL};
  FS_ALLOC(ctx, U, n + p + 1);
  FS_ALLOC(ctx, points, (size_t)n * w);
  for (int32_t i = p; i <= k->n; i++) { /* every value inside p times, those at the ends once more */
    if (i > p && k->knot[i] == k->knot[i - 1]) continue;
    if (ends != NULL) ends[piece] = k->knot[i];
    for (int32_t m = piece == 0 || piece == n_spans ? p + 1 : p; m > 0; m--) U[used++] = k->knot[i];
    piece++;
  }
  full.knot = U;
  FS_TRY(fs_bspline_refine(ctx, k, width, c, &full, points));
  for (piece = 0; piece < n_spans; piece++)
    memcpy(bezier + (size_t)(piece * (p + 1)) * w, points + (size_t)(piece * p) * w, (size_t)(p + 1) * w * sizeof *c);
done:
  fs_release(ctx, U);
  fs_release(ctx, points);
  return status;
}

/* Row i of the band: columns i - p .. i + p. */
fs_status fs_bspline_interpolate(fs_context *ctx, const fs_knots *k, int32_t width, double *c) {
  fs_status status = FS_OK;
  int32_t p = k->degree, n = k->n, stride = 2 * p + 1;
  size_t w = (size_t)width;
  double *band = NULL, basis[FS_KNOTS_MAX_DEGREE + 1];
  FS_ALLOC(ctx, band, (size_t)n * (size_t)stride);
  for (int32_t i = 0; i < n; i++) {
    double t = fs_knots_greville(k, i);
    int32_t s = fs_knots_span(k, t);
    fs_knots_basis(k, s, t, 0, basis);
    for (int32_t j = 0; j <= p; j++) {
      int32_t column = s - p + j - i + p; /* |s - p + j - i| <= p, for N_j > 0 at t */
      if (column >= 0 && column < stride) band[(size_t)i * (size_t)stride + (size_t)column] = basis[j];
    }
  }
  for (int32_t i = 0; i < n; i++) {
    double *row = band + (size_t)i * (size_t)stride, *value = c + (size_t)i * w;
    if (!(fabs(row[p]) > 0)) {
      status = fs_fail(ctx, FS_ERR_NUMERIC, "interpolation by a spline broke down at coefficient %d", (int)i);
      goto done;
    }
    for (int32_t below = 1; below <= p && i + below < n; below++) {
      double *other = row + (size_t)below * (size_t)stride, *other_value = value + (size_t)below * w;
      double factor = other[p - below] / row[p];
      if (factor == 0) continue;
      for (int32_t j = 0; j <= p; j++) other[p - below + j] -= factor * row[p + j];
      for (size_t j = 0; j < w; j++) other_value[j] -= factor * value[j];
    }
  }
  for (int32_t i = n - 1; i >= 0; i--) {
    const double *row = band + (size_t)i * (size_t)stride;
    double *value = c + (size_t)i * w;
    for (int32_t above = 1; above <= p && i + above < n; above++)
      for (size_t j = 0; j < w; j++) value[j] -= row[p + above] * value[(size_t)above * w + j];
    for (size_t j = 0; j < w; j++) value[j] /= row[p];
  }
done:
  fs_release(ctx, band);
  return status;
}
