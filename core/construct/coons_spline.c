/* SPDX-License-Identifier: MIT */
/* Single role: the bilinear Coons patch of B-spline sides as a B-spline patch. A B-spline whose points are those of a linear
   function at the Greville abscissae is that function, so with a_i, b_j the abscissae mapped to [0, 1]
     C_ij = (1 - b_j) c_0i + b_j c_1i + (1 - a_i) d_0j + a_i d_1j
            - (1 - a_i)(1 - b_j) P_00 - a_i (1 - b_j) P_10 - (1 - a_i) b_j P_01 - a_i b_j P_11. */
#include "construct/coons.h"
#include "math/vec3.h"

static fs_status check_knots(fs_context *ctx, const char *direction, int32_t degree, int32_t n, const double *knot) {
  if (degree < 1 || degree > FS_MAX_DEGREE || n <= degree)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%d points cannot make a B-spline of degree %d along %s", (int)n, (int)degree,
                   direction);
  for (int32_t k = 0; k <= n + degree; k++) {
    if (!isfinite(knot[k])) return fs_fail(ctx, FS_ERR_ARGUMENT, "knot %d along %s is not finite", (int)k, direction);
    if (k > 0 && knot[k] < knot[k - 1])
      return fs_fail(ctx, FS_ERR_ARGUMENT, "knot %d along %s is %g and below knot %d, %g", (int)k, direction, knot[k],
                     (int)k - 1, knot[k - 1]);
    bool is_end = (k <= degree && knot[k] != knot[0]) || (k >= n && knot[k] != knot[n + degree]);
    if (is_end)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "knot %d along %s is %g: the first and last %d must be equal", (int)k,
                     direction, knot[k], (int)degree + 1);
  }
  if (!(knot[n] > knot[degree])) return fs_fail(ctx, FS_ERR_ARGUMENT, "the knots along %s span no interval", direction);
  return FS_OK;
}

/* The abscissa of point i in [0, 1]. */
static double greville(int32_t degree, int32_t n, const double *knot, int32_t i) {
  double sum = 0;
  for (int32_t k = 1; k <= degree; k++) sum += (knot[i + k] - knot[0]) / degree;
  return sum / (knot[n] - knot[0]);
}

static fs_status check_corners(fs_context *ctx, int32_t n_u, const fs_vec3 *const at_v[2], int32_t n_v,
                               const fs_vec3 *const at_u[2], double tolerance) {
  fs_vec3 min = {INFINITY, INFINITY, INFINITY}, max = {-INFINITY, -INFINITY, -INFINITY};
  for (int32_t side = 0; side < 2; side++) {
    for (int32_t i = 0; i < n_u; i++) min = fs_vec3_min(min, at_v[side][i]), max = fs_vec3_max(max, at_v[side][i]);
    for (int32_t j = 0; j < n_v; j++) min = fs_vec3_min(min, at_u[side][j]), max = fs_vec3_max(max, at_u[side][j]);
  }
  for (int32_t i = 0; i < 2; i++)
    for (int32_t j = 0; j < 2; j++) {
      double gap = fs_vec3_distance(at_v[j][i ? n_u - 1 : 0], at_u[i][j ? n_v - 1 : 0]);
      if (!(gap <= tolerance * fs_vec3_distance(min, max)))
        return fs_fail(ctx, FS_ERR_NUMERIC, "the sides u = %d and v = %d differ at (%d, %d) by %.3g in S", (int)i,
                       (int)j, (int)i, (int)j, gap);
    }
  return FS_OK;
}

fs_status fs_coons_spline_net(fs_context *ctx, int32_t degree_u, int32_t n_u, const double *knot_u,
                              const fs_vec3 *const at_v[2], int32_t degree_v, int32_t n_v, const double *knot_v,
                              const fs_vec3 *const at_u[2], double tolerance, fs_vec3 *net) {
  fs_status status = FS_OK;
  FS_TRY(check_knots(ctx, "u", degree_u, n_u, knot_u));
  FS_TRY(check_knots(ctx, "v", degree_v, n_v, knot_v));
  FS_TRY(check_corners(ctx, n_u, at_v, n_v, at_u, tolerance));
  for (int32_t j = 0; j < n_v; j++) {
    double b = greville(degree_v, n_v, knot_v, j);
    for (int32_t i = 0; i < n_u; i++) {
      double a = greville(degree_u, n_u, knot_u, i);
      fs_vec3 sum = fs_vec3_add_scaled(fs_vec3_scale(at_v[0][i], 1 - b), at_v[1][i], b);
      sum = fs_vec3_add_scaled(fs_vec3_add_scaled(sum, at_u[0][j], 1 - a), at_u[1][j], a);
      sum = fs_vec3_add_scaled(sum, at_v[0][0], -(1 - a) * (1 - b));
      sum = fs_vec3_add_scaled(sum, at_v[0][n_u - 1], -a * (1 - b));
      sum = fs_vec3_add_scaled(sum, at_v[1][0], -(1 - a) * b);
      net[i + n_u * j] = fs_vec3_add_scaled(sum, at_v[1][n_u - 1], -a * b);
    }
  }
done:
  return status;
}
