/* SPDX-License-Identifier: MIT */
/* Single role: a filling over given knots. With the four or six columns S_i of points by u,
     degree 3:  S_0 = q, S_1 = S_0 + s_u(0) / 3, and the same from the end of r;
     degree 5:  S_0 = q, S_1 = S_0 + s_u(0) / 5, S_2 = S_0 + 2 s_u(0) / 5 + s_uu(0) / 20, and the same from the end of r with
                - s_u(1).
   approximate: q exactly, by inserting knots; s_u and s_uu by interpolation at the Greville abscissae (error of order 4).
   multiply:    c1, g1 by interpolation; s_u = c1 q_u, s_uu = c1^2 q_uu as products of the pieces in Bernstein form. */
#include "construct/gap.h"
#include "math/bernstein.h"
#include "math/vec3.h"

#include <string.h>

enum { MAX_COLUMNS = 6, MAX_DEGREE_V = 9 };

static void set_name(fs_spline *s) { memcpy(s->name, "filling", sizeof "filling"); }

/* Columns 0, 1 (and 2) on the side of a seam from position, s_u, s_uu, all [n][3]; c[n][n_columns][3]. */
static void place(const fs_gap *gap, int side, int32_t n, const double *p, const double *su, const double *suu,
                  double *c) {
  int32_t degree = gap->options.order == 1 ? 3 : 5, columns = degree + 1;
  double sign = gap->seam[side].sign;
  for (int32_t j = 0; j < n; j++)
    for (int w = 0; w < 3; w++) {
      double *row = c + 3 * (size_t)(columns * j) + w;
      int32_t at[3] = {side == 0 ? 0 : degree, side == 0 ? 1 : degree - 1, side == 0 ? 2 : degree - 2};
      size_t i = 3 * (size_t)j + (size_t)w;
      row[3 * at[0]] = p[i];
      row[3 * at[1]] = p[i] + sign * su[i] / degree;
      if (degree == 5) row[3 * at[2]] = p[i] + sign * 2 * su[i] / 5 + suu[i] / 20;
    }
}

/* The filling as an object; knots by v of degree degree_v. */
static fs_status make(fs_context *ctx, const fs_gap *gap, int32_t degree_v, int32_t n, const double *knot,
                      const double *c, fs_spline **filling) {
  double by_u[2 * MAX_COLUMNS] = {0};
  int32_t columns = gap->options.order == 1 ? 4 : 6;
  fs_spline like = {.n_parameters = 2, .width = 3, .degree = {columns - 1, degree_v}, .n = {columns, n}};
  for (int32_t i = 0; i < columns; i++) by_u[columns + i] = 1;
  set_name(&like);
  like.knot[0] = by_u;
  like.knot[1] = (double *)knot;
  like.c = (double *)c;
  return fs_spline_create(ctx, &like, filling);
}

/* values[n][3] of (scale)^power times the derivative of that order, at the Greville abscissae; then coefficients. */
static fs_status interpolate(fs_context *ctx, const fs_gap *gap, int side, int32_t order, const fs_knots *knots,
                             double *values) {
  for (int32_t i = 0; i < knots->n; i++) {
    double v = fs_knots_greville(knots, i), scale = fs_gap_scale(gap, side, v);
    fs_vec3 x = fs_vec3_scale(fs_gap_seam_point(&gap->seam[side], v, order), order == 1 ? scale : scale * scale);
    memcpy(values + 3 * (size_t)i, &x, sizeof x);
  }
  return fs_bspline_interpolate(ctx, knots, 3, values);
}

fs_status fs_gap_approximate(fs_context *ctx, const fs_gap *gap, const fs_knots *knots, fs_spline **filling) {
  fs_status status = FS_OK;
  int32_t n = knots->n, columns = gap->options.order == 1 ? 4 : 6;
  double *column[3] = {NULL, NULL, NULL}, *c = NULL;
  for (int k = 0; k < 3; k++) FS_ALLOC(ctx, column[k], 3 * (size_t)n);
  FS_ALLOC(ctx, c, 3 * (size_t)n * (size_t)columns);
  for (int side = 0; side < 2; side++) {
    const fs_gap_seam *seam = &gap->seam[side];
    FS_TRY(fs_bspline_refine(ctx, &seam->knots, 3, seam->c[0], knots, column[0]));
    FS_TRY(interpolate(ctx, gap, side, 1, knots, column[1]));
    if (gap->options.order == 2) FS_TRY(interpolate(ctx, gap, side, 2, knots, column[2]));
    place(gap, side, n, column[0], column[1], column[2], c);
  }
  FS_TRY(make(ctx, gap, 3, n, knots->knot, c, filling));
done:
  for (int k = 0; k < 3; k++) fs_release(ctx, column[k]);
  fs_release(ctx, c);
  return status;
}

/* ---- exact ---- */

/* Knots of degree d = 2 or 3 at the values of knots of degree 3: d + 1 times at the ends; inside as often or, for d = 2,
   once less, but at least once. Returns the number of coefficients. */
static int32_t scalar_knots(const fs_knots *knots, int32_t d, double *out) {
  int32_t n = 0, n_knots = knots->n + 4;
  for (int32_t i = 0, m; i < n_knots; i += m) {
    const double value = knots->knot[i];
    int32_t kept;
    for (m = 1; i + m < n_knots && knots->knot[i + m] == value;) m++;
    kept = i == 0 || i + m == n_knots ? d + 1 : m - (3 - d) < 1 ? 1 : m - (3 - d);
    for (int32_t k = 0; k < kept; k++) out[n++] = value;
  }
  return n - d - 1;
}

/* Bernstein pieces [n_spans][d + 1] of the spline that interpolates c1 or g1. */
static fs_status scalar_pieces(fs_context *ctx, const fs_gap *gap, int side, const fs_knots *knots, double *pieces,
                               bool *is_positive) {
  fs_status status = FS_OK;
  int32_t d = gap->options.scalar_degree, n_spans = fs_knots_n_spans(knots);
  double *U = NULL, *c = NULL;
  fs_knots own = {.degree = d};
  FS_ALLOC(ctx, U, knots->n + 4);
  own.n = scalar_knots(knots, d, U);
  own.knot = U;
  FS_ALLOC(ctx, c, own.n);
  for (int32_t i = 0; i < own.n; i++) c[i] = fs_gap_scale(gap, side, fs_knots_greville(&own, i));
  FS_TRY(fs_bspline_interpolate(ctx, &own, 1, c));
  FS_TRY(fs_bspline_bezier(ctx, &own, 1, c, pieces, NULL));
  for (int32_t i = 0; i < n_spans * (d + 1); i++)
    if (!(pieces[i] > 0)) *is_positive = false;
done:
  fs_release(ctx, U);
  fs_release(ctx, c);
  return status;
}

/* Bernstein pieces [n_spans][4][3] of a derivative at a seam. */
static fs_status seam_pieces(fs_context *ctx, const fs_gap_seam *seam, int32_t order, const fs_knots *knots,
                             double *pieces) {
  fs_status status = FS_OK;
  double *c = NULL;
  FS_ALLOC(ctx, c, 3 * (size_t)knots->n);
  FS_TRY(fs_bspline_refine(ctx, &seam->knots, 3, seam->c[order], knots, c));
  FS_TRY(fs_bspline_bezier(ctx, knots, 3, c, pieces, NULL));
done:
  fs_release(ctx, c);
  return status;
}

/* out[degree_v + 1][3] = scalar^power times piece[4][3] */
static void multiply_piece(int32_t d, const double *scalar, int32_t power, const double *piece, int32_t degree_v,
                           double *out) {
  double square[7] = {0}, product[3 * (MAX_DEGREE_V + 1)] = {0};
  const double *factor = scalar;
  int32_t degree = d * power;
  if (power == 2) {
    fs_bernstein_add_product(d, scalar, d, 1, scalar, square);
    factor = square;
  }
  if (power == 0) {
    fs_bernstein_elevate(3, 3, piece, degree_v, out);
    return;
  }
  fs_bernstein_add_product(degree, factor, 3, 3, piece, product);
  fs_bernstein_elevate(3 + degree, 3, product, degree_v, out);
}

/* Fills the columns of one side from the pieces; the last point of a piece is the first of the next. */
static fs_status multiply_side(fs_context *ctx, const fs_gap *gap, int side, const fs_knots *knots, bool *is_positive,
                               double *c) {
  fs_status status = FS_OK;
  int32_t d = gap->options.scalar_degree, order = gap->options.order, n_spans = fs_knots_n_spans(knots);
  int32_t degree_v = 3 + order * d, n = degree_v * n_spans + 1;
  double *scalar = NULL, *piece = NULL, *column[3] = {NULL, NULL, NULL};
  FS_ALLOC(ctx, scalar, (size_t)n_spans * (size_t)(d + 1));
  FS_ALLOC(ctx, piece, (size_t)n_spans * 12);
  for (int k = 0; k < 3; k++) FS_ALLOC(ctx, column[k], 3 * (size_t)n);
  FS_TRY(scalar_pieces(ctx, gap, side, knots, scalar, is_positive));
  for (int32_t k = 0; k <= order; k++) {
    FS_TRY(seam_pieces(ctx, &gap->seam[side], k, knots, piece));
    for (int32_t i = 0; i < n_spans; i++)
      multiply_piece(d, scalar + i * (d + 1), k, piece + 12 * (size_t)i, degree_v,
                     column[k] + 3 * (size_t)(degree_v * i));
  }
  place(gap, side, n, column[0], column[1], column[2], c);
done:
  fs_release(ctx, scalar);
  fs_release(ctx, piece);
  for (int k = 0; k < 3; k++) fs_release(ctx, column[k]);
  return status;
}

fs_status fs_gap_multiply(fs_context *ctx, const fs_gap *gap, const fs_knots *knots, bool *is_positive,
                          fs_spline **filling) {
  fs_status status = FS_OK;
  int32_t columns = gap->options.order == 1 ? 4 : 6, degree_v = 3 + gap->options.order * gap->options.scalar_degree;
  int32_t n_spans = fs_knots_n_spans(knots), n = degree_v * n_spans + 1, used = 0;
  double *U = NULL, *c = NULL;
  FS_ALLOC(ctx, U, n + degree_v + 1);
  FS_ALLOC(ctx, c, 3 * (size_t)n * (size_t)columns);
  *is_positive = true;
  for (int side = 0; side < 2; side++) FS_TRY(multiply_side(ctx, gap, side, knots, is_positive, c));
  if (!*is_positive) goto done;
  for (int32_t i = 3; i <= knots->n; i++) {
    if (i > 3 && knots->knot[i] == knots->knot[i - 1]) continue;
    for (int32_t m = used == 0 || knots->knot[i] == knots->knot[knots->n] ? degree_v + 1 : degree_v; m > 0; m--)
      U[used++] = knots->knot[i];
  }
  FS_TRY(make(ctx, gap, degree_v, n, U, c, filling));
done:
  fs_release(ctx, U);
  fs_release(ctx, c);
  return status;
}
