/* SPDX-License-Identifier: MIT */
/* Single role: B-spline patches as Bezier patches: first by u for every row of points, then by v. */
#include "surface/spline.h"

#include <string.h>

/* points[n_spans_u (degree_u + 1)][n_v][3], transposed so that v may follow: by u first. */
static fs_status split_u(fs_context *ctx, const fs_spline *s, double *points) {
  fs_status status = FS_OK;
  fs_knots knots = fs_spline_knots(s, 0);
  int32_t n_columns = fs_knots_n_spans(&knots) * (s->degree[0] + 1);
  double *row = NULL;
  FS_ALLOC(ctx, row, 3 * (size_t)n_columns);
  for (int32_t j = 0; j < s->n[1]; j++) {
    FS_TRY(fs_bspline_bezier(ctx, &knots, 3, s->c + 3 * (size_t)j * (size_t)s->n[0], row, NULL));
    for (int32_t i = 0; i < n_columns; i++)
      memcpy(points + 3 * ((size_t)i * (size_t)s->n[1] + (size_t)j), row + 3 * i, 3 * sizeof *row);
  }
done:
  fs_release(ctx, row);
  return status;
}

static void link_patch(fs_patch *patch, int32_t first, int32_t i, int32_t j, int32_t n_u, int32_t n_v) {
  static const int8_t step[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  for (int s = 0; s < 4; s++) {
    int32_t a = i + step[s][0], b = j + step[s][1];
    bool is_inside = a >= 0 && b >= 0 && a < n_u && b < n_v;
    patch->neighbour[s] = is_inside ? first + a + n_u * b : FS_NONE;
    patch->neighbour_side[s] = is_inside ? (uint8_t)((s + 2) % 4) : 0;
  }
}

/* Fills the patches from first on and their points from data_start on, which are advanced. */
static fs_status add_pieces(fs_context *ctx, const fs_spline *s, fs_surface *surface, int32_t *first,
                            size_t *data_start) {
  fs_status status = FS_OK;
  fs_knots knots_u = fs_spline_knots(s, 0), knots_v = fs_spline_knots(s, 1);
  int32_t n_u = fs_knots_n_spans(&knots_u), n_v = fs_knots_n_spans(&knots_v), p = s->degree[0], q = s->degree[1];
  size_t n_points = (size_t)(p + 1) * (size_t)(q + 1);
  double *by_u = NULL, *column = NULL;
  FS_ALLOC(ctx, by_u, 3 * (size_t)(n_u * (p + 1)) * (size_t)s->n[1]);
  FS_ALLOC(ctx, column, 3 * (size_t)(n_v * (q + 1)));
  FS_TRY(split_u(ctx, s, by_u));
  for (int32_t j = 0; j < n_v; j++)
    for (int32_t i = 0; i < n_u; i++) {
      fs_patch *patch = &surface->patch[*first + i + n_u * j];
      *patch = (fs_patch){.kind = FS_PATCH_TENSOR_BEZIER,
                          .n_sides = 4,
                          .degree_u = p,
                          .degree_v = q,
                          .data_start = *data_start + 3 * n_points * (size_t)(i + n_u * j),
                          .face = FS_NONE,
                          .valence = 4};
      link_patch(patch, *first, i, j, n_u, n_v);
    }
  for (int32_t a = 0; a < n_u * (p + 1); a++) {
    FS_TRY(fs_bspline_bezier(ctx, &knots_v, 3, by_u + 3 * (size_t)a * (size_t)s->n[1], column, NULL));
    for (int32_t b = 0; b < n_v * (q + 1); b++) {
      size_t piece = (size_t)(a / (p + 1) + n_u * (b / (q + 1)));
      size_t point = (size_t)(a % (p + 1) + (p + 1) * (b % (q + 1)));
      memcpy(surface->data + *data_start + 3 * (n_points * piece + point), column + 3 * b, 3 * sizeof *column);
    }
  }
  *first += n_u * n_v;
  *data_start += 3 * n_points * (size_t)(n_u * n_v);
done:
  fs_release(ctx, by_u);
  fs_release(ctx, column);
  return status;
}

fs_status fs_splines_surface(fs_context *ctx, int32_t n_splines, const fs_spline *const *spline, fs_surface **surface) {
  fs_status status = FS_OK;
  fs_surface *made = NULL;
  int64_t n_patches = 0, n_data = 0;
  int32_t first = 0;
  size_t start = 0;
  for (int32_t k = 0; k < n_splines; k++) {
    const fs_spline *s = spline[k];
    if (s->n_parameters != 2 || s->width != 3) return fs_fail(ctx, FS_ERR_ARGUMENT, "'%s' is no patch", s->name);
    fs_knots knots_u = fs_spline_knots(s, 0), knots_v = fs_spline_knots(s, 1);
    if (s->degree[0] < 1 || s->degree[1] < 1)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "the patch '%s' has degree (%d, %d): a surface needs 1 or more", s->name,
                     (int)s->degree[0], (int)s->degree[1]);
    int64_t pieces = (int64_t)fs_knots_n_spans(&knots_u) * fs_knots_n_spans(&knots_v);
    n_patches += pieces;
    n_data += 3 * pieces * (s->degree[0] + 1) * (s->degree[1] + 1);
  }
  if (n_patches > INT32_MAX / 4)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the splines have more pieces than can be numbered");
  FS_ALLOC(ctx, made, 1);
  made->n_patches = (int32_t)n_patches;
  made->n_data = (size_t)n_data;
  FS_ALLOC(ctx, made->patch, n_patches);
  FS_ALLOC(ctx, made->data, n_data);
  for (int32_t k = 0; k < n_splines; k++) FS_TRY(add_pieces(ctx, spline[k], made, &first, &start));
  FS_TRY(fs_surface_stitch(ctx, made, 1e-9, NULL));
  *surface = made;
  made = NULL;
done:
  fs_surface_free(ctx, made);
  return status;
}
