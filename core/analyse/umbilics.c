/* SPDX-License-Identifier: MIT */
/* Single role: umbilics. In the frame e1 along p_u the second fundamental form is [a b; b c]; an umbilic is a zero of
   q = ((a - c) / 2, b), found by Newton's method from the cells where |q| has a least value. Twice the index of the field of
   principal directions is the sign of det dq in that frame [Berry and Hannay 1977]: 1 lemon or monstar, -1 star. */
#include "analyse/curves.h"
#include "math/diffgeo.h"
#include "math/vec3.h"

enum { NEWTON_STEPS = 30 };

typedef struct search {
  const fs_surface *surface;
  int32_t patch, n;
  double scale; /* of curvatures: the largest of H on the patches */
} search;

static bool difference(const search *s, double u, double v, double q[2]) {
  fs_vec3 x[FS_JET_SIZE];
  fs_geometry g;
  fs_surface_evaluate(s->surface, s->patch, u, v, x);
  if (!fs_geometry_compute(x, &g)) return false;
  q[0] = 0.5 * (g.a - g.c), q[1] = g.b;
  return isfinite(q[0]) && isfinite(q[1]);
}

/* dq[i][j]: q_i by u, v. */
static bool derivative(const search *s, double u, double v, double dq[2][2]) {
  const double h = 1e-6;
  double a[2], b[2];
  for (int j = 0; j < 2; j++) {
    double du = j == 0 ? h : 0, dv = j == 1 ? h : 0;
    if (!difference(s, u - du, v - dv, a) || !difference(s, u + du, v + dv, b)) return false;
    for (int i = 0; i < 2; i++) dq[i][j] = (b[i] - a[i]) / (2 * h);
  }
  return true;
}

/* From (u, v) to the umbilic near it, at most a cell and a half away and within the patch. */
static bool polish(const search *s, double *u, double *v, int32_t *index) {
  double start[2] = {*u, *v}, q[2], dq[2][2], det = 0;
  const double edge = 1e-9;
  for (int k = 0; k < NEWTON_STEPS; k++) {
    double du, dv;
    if (!difference(s, *u, *v, q) || !derivative(s, *u, *v, dq)) return false;
    det = dq[0][0] * dq[1][1] - dq[0][1] * dq[1][0];
    /* a region of umbilics, or a curve of them, is no point */
    if (!(fabs(det) > 1e-6 * s->scale * s->scale)) return false;
    du = (q[0] * dq[1][1] - q[1] * dq[0][1]) / det, dv = (dq[0][0] * q[1] - dq[1][0] * q[0]) / det;
    *u -= du, *v -= dv;
    if (fabs(*u - start[0]) > 1.5 / s->n || fabs(*v - start[1]) > 1.5 / s->n) return false;
    if (fabs(du) + fabs(dv) < 1e-13) break;
  }
  if (*u < -edge || *u > 1 + edge || *v < -edge || *v > 1 + edge) return false;
  if (!difference(s, *u, *v, q) || hypot(q[0], q[1]) > 1e-9 * s->scale) return false;
  *index = det > 0 ? 1 : -1;
  return true;
}

static double least_around(const double *size, int32_t n, int32_t i, int32_t j) {
  double least = INFINITY;
  for (int32_t b = j > 0 ? j - 1 : 0; b <= j + 1 && b <= n; b++)
    for (int32_t a = i > 0 ? i - 1 : 0; a <= i + 1 && a <= n; a++) least = fmin(least, size[a + (n + 1) * b]);
  return least;
}

/* Once per point, though patches that share a side find it on both. */
static fs_status add(fs_context *ctx, const search *s, double u, double v, int32_t index, double diagonal,
                     fs_curve_list *list) {
  fs_mark mark = {.point = fs_curve_point_at(s->surface, s->patch, fmin(fmax(u, 0), 1), fmin(fmax(v, 0), 1)),
                  .index = index};
  for (int32_t i = 0; i < list->curves->n_marks; i++)
    if (fs_vec3_distance(list->curves->mark[i].point.position, mark.point.position) < 1e-6 * diagonal) return FS_OK;
  return fs_curve_list_mark(ctx, list, &mark);
}

static double scale_of(const fs_surface *surface) {
  double scale = 0;
  for (int32_t p = 0; p < surface->n_patches; p++) {
    fs_vec3 x[FS_JET_SIZE];
    fs_geometry g;
    fs_surface_evaluate(surface, p, 0.5, 0.5, x);
    if (fs_geometry_compute(x, &g)) scale = fmax(scale, sqrt(fabs(2 * g.H * g.H - g.K) * 2));
  }
  return scale;
}

fs_status fs_umbilics_append(fs_context *ctx, const fs_surface *surface, int32_t n_cells, double diagonal,
                             fs_curve_list *list) {
  fs_status status = FS_OK;
  search s = {.surface = surface, .n = n_cells, .scale = scale_of(surface)};
  double *size = NULL;
  int32_t n = n_cells;
  FS_ALLOC(ctx, size, (size_t)(n + 1) * (size_t)(n + 1));
  for (s.patch = 0; s.patch < surface->n_patches && s.scale > 0; s.patch++) {
    for (int32_t k = 0; k < (n + 1) * (n + 1); k++) {
      double q[2];
      bool is_regular = difference(&s, (double)(k % (n + 1)) / n, (double)(k / (n + 1)) / n, q);
      size[k] = is_regular ? hypot(q[0], q[1]) : (double)INFINITY;
    }
    for (int32_t k = 0; k < (n + 1) * (n + 1); k++) {
      int32_t i = k % (n + 1), j = k / (n + 1), index;
      double u = (double)i / n, v = (double)j / n;
      if (!isfinite(size[k]) || size[k] > least_around(size, n, i, j)) continue;
      if (polish(&s, &u, &v, &index)) FS_TRY(add(ctx, &s, u, v, index, diagonal, list));
    }
    FS_TRY(fs_progress(ctx, "umbilics", (double)s.patch / surface->n_patches));
  }
done:
  fs_release(ctx, size);
  return status;
}

fs_status fs_trace_umbilics(fs_context *ctx, const fs_surface *surface, const fs_trace_options *options,
                            fs_curves **curves) {
  fs_status status = FS_OK;
  fs_trace_options o = fs_trace_options_complete(surface, options);
  fs_surface *quads = NULL;
  fs_curve_list list = {0};
  FS_TRY(fs_surface_to_quads(ctx, surface, &quads));
  FS_TRY(fs_curve_list_start(ctx, &list));
  FS_TRY(fs_umbilics_append(ctx, quads, o.n_cells, fs_surface_diagonal(quads, NULL), &list));
  *curves = list.curves;
  list.curves = NULL;
done:
  fs_curves_free(ctx, list.curves);
  fs_surface_free(ctx, quads);
  return status;
}
