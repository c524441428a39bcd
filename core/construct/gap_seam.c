/* SPDX-License-Identifier: MIT */
/* Single role: the two seams of a gap, with every check that the filling needs. */
#include "construct/gap.h"
#include "math/vec3.h"

#include <stdio.h>
#include <string.h>

static fs_status open_seam(fs_context *ctx, const fs_spline *patch, int side, fs_gap_seam *seam) {
  fs_status status = FS_OK;
  fs_knots by_u = fs_spline_knots(patch, 0);
  size_t row = 3 * (size_t)patch->n[0];
  seam->patch = patch;
  seam->sign = side == 0 ? 1 : -1;
  seam->u = side == 0 ? by_u.knot[by_u.n] : by_u.knot[0];
  seam->knots = fs_spline_knots(patch, 1);
  for (int32_t order = 0; order < 3; order++) {
    FS_ALLOC(ctx, seam->c[order], 3 * (size_t)patch->n[1]);
    for (int32_t j = 0; j < patch->n[1]; j++)
      fs_bspline_evaluate(&by_u, 3, patch->c + row * (size_t)j, seam->u, order, seam->c[order] + 3 * (size_t)j);
  }
done:
  return status;
}

fs_vec3 fs_gap_seam_point(const fs_gap_seam *seam, double v, int32_t order) {
  double x[3];
  fs_bspline_evaluate(&seam->knots, 3, seam->c[order], v, 0, x);
  return (fs_vec3){x[0], x[1], x[2]};
}

double fs_gap_scale(const fs_gap *gap, int side, double v) {
  double distance = fs_vec3_distance(fs_gap_seam_point(&gap->seam[0], v, 0), fs_gap_seam_point(&gap->seam[1], v, 0));
  return gap->options.factor[side] * distance / fs_vec3_length(fs_gap_seam_point(&gap->seam[side], v, 1));
}

static fs_status check_options(fs_context *ctx, fs_gap_options *o) {
  if (o->order == 0) o->order = 1;
  if (o->scalar_degree == 0) o->scalar_degree = 3;
  if (o->angle == 0) o->angle = 1e-4;
  for (int k = 0; k < 2; k++) {
    if (o->factor[k] == 0) o->factor[k] = 1;
    if (!(o->factor[k] > 0) || !isfinite(o->factor[k]))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "the factor of side %d is %g, which is not positive", k, o->factor[k]);
  }
  if (o->order < 1 || o->order > 2)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "a gap is filled with order 1 or 2, not %d", (int)o->order);
  if (o->scalar_degree < 2 || o->scalar_degree > 3)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the scalars have degree 2 or 3, not %d", (int)o->scalar_degree);
  if (!(o->angle > 0)) return fs_fail(ctx, FS_ERR_ARGUMENT, "the angle %g is not positive", o->angle);
  if (o->n_parts < 0 || o->n_parts > FS_GAP_MAX_SPANS)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "a span cannot be cut into %d parts", (int)o->n_parts);
  return FS_OK;
}

static fs_status check_patches(fs_context *ctx, const fs_spline *q, const fs_spline *r) {
  const fs_spline *const both[2] = {q, r};
  for (int k = 0; k < 2; k++) {
    if (both[k]->n_parameters != 2 || both[k]->width != 3)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "'%s' is no patch", both[k]->name);
    if (both[k]->degree[1] != 3 || both[k]->degree[0] < 1)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "the patch '%s' has degree (%d, %d); a seam needs degree 3 by v",
                     both[k]->name, (int)both[k]->degree[0], (int)both[k]->degree[1]);
  }
  if (q->knot[1][0] != r->knot[1][0] || q->knot[1][q->n[1]] != r->knot[1][r->n[1]])
    return fs_fail(ctx, FS_ERR_ARGUMENT, "'%s' has v from %g to %g, but '%s' from %g to %g", q->name, q->knot[1][0],
                   q->knot[1][q->n[1]], r->name, r->knot[1][0], r->knot[1][r->n[1]]);
  return FS_OK;
}

static double size_of(const fs_gap *gap) {
  fs_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
  for (int side = 0; side < 2; side++)
    for (int32_t i = 0; i < gap->seam[side].knots.n; i++) {
      const double *c = gap->seam[side].c[0] + 3 * (size_t)i;
      low = fs_vec3_min(low, (fs_vec3){c[0], c[1], c[2]}), high = fs_vec3_max(high, (fs_vec3){c[0], c[1], c[2]});
    }
  return fs_vec3_distance(low, high);
}

/* Distances, lengths and directions at equidistant points. */
static fs_status check_seams(fs_context *ctx, const fs_gap *gap) {
  enum { N = 129 };
  const fs_knots *k = &gap->seam[0].knots;
  double size = size_of(gap), a = k->knot[0], b = k->knot[k->n];
  int n_away[2] = {0, 0};
  for (int i = 0; i < N; i++) {
    double v = a + (b - a) * i / (N - 1);
    fs_vec3 across = fs_vec3_sub(fs_gap_seam_point(&gap->seam[1], v, 0), fs_gap_seam_point(&gap->seam[0], v, 0));
    if (!(fs_vec3_length(across) > 1e-9 * size))
      return fs_fail(ctx, FS_ERR_NUMERIC, "'%s' and '%s' touch at v = %g: there is no gap to fill",
                     gap->seam[0].patch->name, gap->seam[1].patch->name, v);
    for (int side = 0; side < 2; side++) {
      fs_vec3 derivative = fs_gap_seam_point(&gap->seam[side], v, 1);
      if (!(fs_vec3_length(derivative) >= 1e-9 * size))
        return fs_fail(ctx, FS_ERR_NUMERIC, "the derivative of '%s' across its seam vanishes at v = %g",
                       gap->seam[side].patch->name, v);
      n_away[side] += !(fs_vec3_dot(derivative, across) > 0);
    }
  }
  for (int side = 0; side < 2; side++) {
    const char *name = gap->seam[side].patch->name;
    if (2 * n_away[side] > N)
      return fs_fail(
          ctx, FS_ERR_ARGUMENT,
          "the derivative of '%s' by u points %s the gap at most points of its seam: turn the patch round, so "
          "that u rises from '%s' over the gap to '%s'",
          name, side == 0 ? "away from" : "back into", gap->seam[0].patch->name, gap->seam[1].patch->name);
    if (n_away[side] > 0)
      fs_note(ctx, "the derivative of '%s' by u points away from the gap at %d of %d points of its seam", name,
              n_away[side], N);
  }
  return FS_OK;
}

fs_status fs_gap_open(fs_context *ctx, const fs_spline *q, const fs_spline *r, const fs_gap_options *options,
                      fs_gap *gap) {
  static const fs_gap_options defaults = {0};
  fs_status status = FS_OK;
  *gap = (fs_gap){.options = options != NULL ? *options : defaults};
  FS_TRY(check_options(ctx, &gap->options));
  FS_TRY(check_patches(ctx, q, r));
  FS_TRY(open_seam(ctx, q, 0, &gap->seam[0]));
  FS_TRY(open_seam(ctx, r, 1, &gap->seam[1]));
  FS_TRY(check_seams(ctx, gap));
done:
  if (status != FS_OK) fs_gap_close(ctx, gap);
  return status;
}

void fs_gap_close(fs_context *ctx, fs_gap *gap) {
  for (int side = 0; side < 2; side++)
    for (int order = 0; order < 3; order++) {
      fs_release(ctx, gap->seam[side].c[order]);
      gap->seam[side].c[order] = NULL;
    }
}
