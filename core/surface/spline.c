/* SPDX-License-Identifier: MIT */
/* Single role: B-splines of one and two parameters as objects. */
#include "surface/spline.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

fs_knots fs_spline_knots(const fs_spline *spline, int direction) {
  return (fs_knots){spline->degree[direction], spline->n[direction], spline->knot[direction]};
}

static size_t n_numbers(const fs_spline *s) { return (size_t)s->n[0] * (size_t)s->n[1] * (size_t)s->width; }

static fs_status check(fs_context *ctx, const fs_spline *s) {
  static const char *const letter[3][2] = {{"", ""}, {"", ""}, {"u ", "v "}};
  char what[FS_SPLINE_NAME + 32];
  if (s->n_parameters < 1 || s->n_parameters > 2 || (s->width != 1 && s->width != 3))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "'%s' has %d parameters and values of %d numbers", s->name,
                   (int)s->n_parameters, (int)s->width);
  for (int d = 0; d < s->n_parameters; d++) {
    fs_knots knots = fs_spline_knots(s, d);
    fs_status status;
    snprintf(what, sizeof what, "the %sknots of '%s'", letter[s->n_parameters][d], s->name);
    status = fs_knots_check(ctx, what, &knots);
    if (status != FS_OK) return status;
  }
  if (s->n_parameters == 1 && (s->n[1] != 1 || s->degree[1] != 0))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the curve '%s' has %d rows of points", s->name, (int)s->n[1]);
  if ((int64_t)s->n[0] * s->n[1] > INT32_MAX / 4)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "'%s' has more points than can be numbered", s->name);
  for (size_t i = 0; i < n_numbers(s); i++)
    if (!isfinite(s->c[i]))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "point %zu of '%s' is not finite", i / (size_t)s->width, s->name);
  return FS_OK;
}

static void clear(fs_context *ctx, fs_spline *spline) {
  fs_release(ctx, spline->knot[0]);
  fs_release(ctx, spline->knot[1]);
  fs_release(ctx, spline->c);
  *spline = (fs_spline){.n_parameters = 0};
}

fs_status fs_spline_copy(fs_context *ctx, const fs_spline *like, fs_spline *spline) {
  static const double unit[2] = {0, 1};
  fs_status status = FS_OK;
  fs_spline made = *like;
  made.name[FS_SPLINE_NAME - 1] = '\0';
  made.knot[0] = made.knot[1] = made.c = NULL;
  if (like->n_parameters == 1) made.degree[1] = 0, made.n[1] = 1;
  FS_TRY(check(ctx, like));
  for (int d = 0; d < 2; d++) {
    size_t n = (size_t)(made.n[d] + made.degree[d] + 1);
    FS_ALLOC(ctx, made.knot[d], n);
    memcpy(made.knot[d], d < like->n_parameters ? like->knot[d] : unit, n * sizeof(double));
  }
  FS_ALLOC(ctx, made.c, n_numbers(&made));
  memcpy(made.c, like->c, n_numbers(&made) * sizeof(double));
  *spline = made;
  made = (fs_spline){.n_parameters = 0};
done:
  clear(ctx, &made);
  return status;
}

fs_status fs_spline_create(fs_context *ctx, const fs_spline *like, fs_spline **spline) {
  fs_status status = FS_OK;
  fs_spline *made = NULL;
  FS_ALLOC(ctx, made, 1);
  FS_TRY(fs_spline_copy(ctx, like, made));
  *spline = made;
  made = NULL;
done:
  fs_release(ctx, made);
  return status;
}

void fs_spline_free(fs_context *ctx, fs_spline *spline) {
  if (spline == NULL) return;
  clear(ctx, spline);
  fs_release(ctx, spline);
}

void fs_splines_free(fs_context *ctx, fs_splines *splines) {
  if (splines == NULL) return;
  for (int32_t i = 0; i < splines->n; i++) clear(ctx, &splines->spline[i]);
  fs_release(ctx, splines->spline);
  fs_release(ctx, splines);
}

const fs_spline *fs_splines_find(const fs_splines *splines, const char *name) {
  for (int32_t i = 0; i < splines->n; i++)
    if (strcmp(splines->spline[i].name, name) == 0) return &splines->spline[i];
  return NULL;
}

void fs_spline_evaluate(const fs_spline *spline, double u, double v, int32_t order_u, int32_t order_v, double *value) {
  double basis[FS_MAX_SPLINE_DEGREE + 1];
  fs_knots knots_u = fs_spline_knots(spline, 0), knots_v = fs_spline_knots(spline, 1);
  int32_t width = spline->width, degree_v = spline->degree[1], first;
  size_t row = (size_t)spline->n[0] * (size_t)width;
  if (spline->n_parameters == 1) {
    fs_bspline_evaluate(&knots_u, width, spline->c, u, order_u, value);
    return;
  }
  first = fs_knots_span(&knots_v, v) - degree_v;
  fs_knots_basis(&knots_v, first + degree_v, v, order_v, basis);
  for (int32_t w = 0; w < width; w++) value[w] = 0;
  for (int32_t j = 0; j <= degree_v; j++) {
    double point[3];
    fs_bspline_evaluate(&knots_u, width, spline->c + (size_t)(first + j) * row, u, order_u, point);
    for (int32_t w = 0; w < width; w++) value[w] += basis[j] * point[w];
  }
}
