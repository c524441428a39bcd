/* SPDX-License-Identifier: MIT */
/* Gregory quads: a bicubic patch whose inner points are p_c for the sides u = 0, 1 and q_c for the sides v = 0, 1, blended:
     S = B(u, v) + sum_c 9 (1 - x)^2 (1 - y)^2 phi(x, y) (q_c - p_c)
   with B the bicubic patch of the points p_c, or a patch of higher degrees, x = u or 1 - u and y = v or 1 - v the distances from corner c, and phi of
   gregory.h   [Chiyokura Kimura 1983; docs/patches.md, B]. */
#include "surface/gregory.h"
#include "surface/surface.h"
#include "math/vec3.h"

size_t fs_gregory_quad_numbers(const fs_patch *patch) {
  if (patch->degree_u < 3 || patch->degree_v < 3) return 0;
  size_t n = fs_tensor_bezier_numbers(patch);
  return n == 0 ? 0 : n + 12;
}

/* w = 9 (1 - x)^2 (1 - y)^2 phi(x, y) and its derivatives by u and v; sx, sy = dx/du, dy/dv are 1 or -1. */
static void corner_weight(double x, double sx, double y, double sy, double *w) {
  const double f[4] = {(1 - x) * (1 - x), -2 * (1 - x), 2, 0}, g[4] = {(1 - y) * (1 - y), -2 * (1 - y), 2, 0};
  double p[FS_JET_SIZE];
  fs_gregory_phi(x, y, p);
  /* first by x alone: columns of (f phi) by its order in y */
  const double c0[4] = {f[0] * p[FS_D], f[1] * p[FS_D] + f[0] * p[FS_DU],
                        f[2] * p[FS_D] + 2 * f[1] * p[FS_DU] + f[0] * p[FS_DUU],
                        3 * f[2] * p[FS_DU] + 3 * f[1] * p[FS_DUU] + f[0] * p[FS_DUUU]};
  const double c1[3] = {f[0] * p[FS_DV], f[1] * p[FS_DV] + f[0] * p[FS_DUV],
                        f[2] * p[FS_DV] + 2 * f[1] * p[FS_DUV] + f[0] * p[FS_DUUV]};
  const double c2[2] = {f[0] * p[FS_DVV], f[1] * p[FS_DVV] + f[0] * p[FS_DUVV]}, c3 = f[0] * p[FS_DVVV];
  w[FS_D] = 9 * g[0] * c0[0];
  w[FS_DU] = 9 * sx * g[0] * c0[1];
  w[FS_DV] = 9 * sy * (g[1] * c0[0] + g[0] * c1[0]);
  w[FS_DUU] = 9 * g[0] * c0[2];
  w[FS_DUV] = 9 * sx * sy * (g[1] * c0[1] + g[0] * c1[1]);
  w[FS_DVV] = 9 * (g[2] * c0[0] + 2 * g[1] * c1[0] + g[0] * c2[0]);
  w[FS_DUUU] = 9 * sx * g[0] * c0[3];
  w[FS_DUUV] = 9 * sy * (g[1] * c0[2] + g[0] * c1[2]);
  w[FS_DUVV] = 9 * sx * (g[2] * c0[1] + 2 * g[1] * c1[1] + g[0] * c2[1]);
  w[FS_DVVV] = 9 * sy * (3 * g[2] * c1[0] + 3 * g[1] * c2[0] + g[0] * c3);
}

void fs_gregory_quad_jet(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x) {
  const int32_t n = patch->degree_u, m = patch->degree_v, row = n + 1;
  const int32_t inner[4] = {1 + row, n - 1 + row, 1 + (m - 1) * row, n - 1 + (m - 1) * row};
  const double *point = data + patch->data_start;
  double w[FS_JET_SIZE];
  fs_tensor_bezier_jet(patch, data, u, v, x);
  if (fs_gregory_quad_numbers(patch) == 0) return;
  for (int c = 0; c < 4; c++) {
    const double *p = point + 3 * inner[c], *q = point + 3 * (row * (m + 1) + c);
    const fs_vec3 difference = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    if (fs_vec3_dot(difference, difference) == 0) continue; /* polynomial, so third derivatives exist at the corner */
    bool is_right = c % 2 == 1, is_upper = c >= 2;
    corner_weight(is_right ? 1 - u : u, is_right ? -1 : 1, is_upper ? 1 - v : v, is_upper ? -1 : 1, w);
    for (int k = 0; k < FS_JET_SIZE; k++) x[k] = fs_vec3_add_scaled(x[k], difference, w[k]);
  }
}
