/* SPDX-License-Identifier: MIT */
/* Single role: how well a filling joins its two patches: distances, angles between normals, and differences of the curvature
   tensors Q = J G^-1 B G^-1 J^T, J = [p_u p_v], which do not depend on the parameters [docs/splines.md]. */
#include "construct/gap.h"
#include "math/diffgeo.h"
#include "math/vec3.h"

/* x[1 .. 5] and position at (u, v). */
static void jet(const fs_spline *s, double u, double v, fs_vec3 *x) {
  static const int8_t order[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  for (int k = 0; k < 6; k++) fs_spline_evaluate(s, u, v, order[k][0], order[k][1], &x[k].x);
}

/* Angle between two lines, also where it is tiny. */
static double line_angle(fs_vec3 a, fs_vec3 b) {
  return atan2(fs_vec3_length(fs_vec3_cross(a, b)), fabs(fs_vec3_dot(a, b)));
}

static double tensor_difference(const fs_geometry *a, const fs_geometry *b) {
  double A[3][3], B[3][3], largest = 0, sign = fs_vec3_dot(a->normal, b->normal) < 0 ? -1 : 1;
  fs_geometry_shape_tensor(a, A);
  fs_geometry_shape_tensor(b, B);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) largest = fmax(largest, fabs(A[i][j] - sign * B[i][j]));
  return largest;
}

static fs_status compare(fs_context *ctx, const fs_gap *gap, int side, const fs_spline *filling, double v,
                         fs_gap_report *report, double *angle) {
  const fs_gap_seam *seam = &gap->seam[side];
  fs_vec3 x[6], y[6];
  fs_geometry g, h;
  jet(seam->patch, seam->u, v, x);
  jet(filling, side, v, y);
  if (!fs_geometry_compute(x, &g))
    return fs_fail(ctx, FS_ERR_NUMERIC, "'%s' has no normal at its seam, v = %g", seam->patch->name, v);
  if (!fs_geometry_compute(y, &h))
    return fs_fail(ctx, FS_ERR_NUMERIC, "the filling has no normal at the seam of '%s', v = %g", seam->patch->name, v);
  *angle = line_angle(g.normal, h.normal);
  report->position = fmax(report->position, fs_vec3_distance(x[0], y[0]));
  report->angle = fmax(report->angle, *angle);
  report->curvature = fmax(report->curvature, tensor_difference(&g, &h));
  double wanted = fs_gap_scale(gap, side, v) * fs_vec3_length(x[1]);
  report->length = fmax(report->length, fabs(fs_vec3_length(y[1]) / wanted - 1));
  return FS_OK;
}

fs_status fs_gap_measure(fs_context *ctx, const fs_gap *gap, const fs_spline *filling, double *span_angle,
                         fs_gap_report *report) {
  fs_status status = FS_OK;
  fs_knots knots = fs_spline_knots(filling, 1);
  fs_gap_report r = {.n_spans = 0};
  for (int32_t i = knots.degree; i < knots.n; i++) {
    double a = knots.knot[i], b = knots.knot[i + 1], largest = 0, angle = 0;
    if (!(a < b)) continue;
    for (int k = 0; k < FS_GAP_SAMPLES; k++) {
      /* just inside of the end, where another piece begins */
      double v = k < FS_GAP_SAMPLES - 1 ? a + (b - a) * k / (FS_GAP_SAMPLES - 1) : b - 1e-12 * (b - a);
      for (int side = 0; side < 2; side++) {
        FS_TRY(compare(ctx, gap, side, filling, v, &r, &angle));
        largest = fmax(largest, angle);
      }
    }
    if (span_angle != NULL) span_angle[r.n_spans] = largest;
    r.n_spans++;
  }
  *report = r;
done:
  return status;
}
