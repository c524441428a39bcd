/* SPDX-License-Identifier: MIT */
/* Single role: how two surfaces differ at a common point, from their derivatives there.

   position |p - q|, normal angle(n, m), curvature |W - V|_F with the shape tensors W = J G^-1 B G^-1 J^T, gradient
   |grad H - grad K| of the mean curvatures. Where the tangent planes agree along a line, so do the normal curvatures along
   it and the geodesic torsion; then W - V = d c c^T with the unit tangent c across the line, and |W - V|_F = |d| is the jump
   of the normal curvature across [Pegna Wolter 1992]. */
#include <fairsurf/analyse.h>
#include "math/diffgeo.h"
#include "math/vec3.h"

const char *const fs_jump_names[FS_N_JUMPS] = {"position", "normal", "curvature", "gradient_H"};

static double frobenius_distance(double a[3][3], double b[3][3]) {
  double sum = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) sum += (a[i][j] - b[i][j]) * (a[i][j] - b[i][j]);
  return sqrt(sum);
}

static double largest_principal(const fs_geometry *g) {
  fs_principal principal;
  fs_geometry_principal(g, &principal);
  return fmax(fabs(principal.maximum), fabs(principal.minimum));
}

static double finite_or_nan(double value) { return isfinite(value) ? value : (double)NAN; }

void fs_jumps_between(const fs_vec3 x[FS_JET_SIZE], const fs_vec3 y[FS_JET_SIZE], bool is_flipped,
                      double jump[FS_N_JUMPS], double *largest_curvature) {
  fs_geometry g, h;
  double W[3][3], V[3][3], sign = is_flipped ? -1 : 1;
  jump[FS_JUMP_POSITION] = finite_or_nan(fs_vec3_distance(x[FS_D], y[FS_D]));
  jump[FS_JUMP_NORMAL] = jump[FS_JUMP_CURVATURE] = jump[FS_JUMP_GRADIENT] = NAN;
  *largest_curvature = 0;
  if (!fs_geometry_compute(x, &g) || !fs_geometry_compute(y, &h)) return;
  jump[FS_JUMP_NORMAL] = finite_or_nan(fs_vec3_angle(g.normal, fs_vec3_scale(h.normal, sign)));
  fs_geometry_shape_tensor(&g, W);
  fs_geometry_shape_tensor(&h, V);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) V[i][j] *= sign;
  jump[FS_JUMP_CURVATURE] = finite_or_nan(frobenius_distance(W, V));
  jump[FS_JUMP_GRADIENT] = finite_or_nan(
      fs_vec3_distance(fs_geometry_mean_gradient(x, &g), fs_vec3_scale(fs_geometry_mean_gradient(y, &h), sign)));
  *largest_curvature = fmax(largest_principal(&g), largest_principal(&h));
  if (!isfinite(*largest_curvature)) *largest_curvature = 0;
}
