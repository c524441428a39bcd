/* SPDX-License-Identifier: MIT */
/* Gregory triangles: a Bezier triangle of degree 4 whose inner point at corner c is q_c for side c and p_c for side c - 1,
   blended:
     S = B(u, v) + sum_c 12 z^2 phi(x, y) (q_c - p_c)
   with B the triangle of the points p_c, phi of gregory.h, and z, x, y the barycentric coordinates of the corners c, c + 1,
   c + 2   [Longhi 1985; weights as in docs/patches.md, B, not those of the source]. */
#include "surface/gregory.h"
#include "surface/jet.h"
#include "surface/surface.h"
#include "math/vec3.h"

enum { N_POINTS = 18 };

size_t fs_gregory_triangle_numbers(const fs_patch *patch) {
  return patch->degree_u == 4 && patch->degree_v == 4 ? 3 * N_POINTS : 0;
}

/* w = 12 (1 - x - y)^2 phi(x, y) and its derivatives by x and y */
static void corner_weight(double x, double y, double *w) {
  const double z = 1 - x - y;
  const double f = 12 * z * z, f1 = -24 * z, f2 = 24; /* derivatives by x, y or both alike */
  double p[FS_JET_SIZE];
  fs_gregory_phi(x, y, p);
  w[FS_D] = f * p[FS_D];
  w[FS_DU] = f1 * p[FS_D] + f * p[FS_DU];
  w[FS_DV] = f1 * p[FS_D] + f * p[FS_DV];
  w[FS_DUU] = f2 * p[FS_D] + 2 * f1 * p[FS_DU] + f * p[FS_DUU];
  w[FS_DUV] = f2 * p[FS_D] + f1 * (p[FS_DU] + p[FS_DV]) + f * p[FS_DUV];
  w[FS_DVV] = f2 * p[FS_D] + 2 * f1 * p[FS_DV] + f * p[FS_DVV];
  w[FS_DUUU] = 3 * f2 * p[FS_DU] + 3 * f1 * p[FS_DUU] + f * p[FS_DUUU];
  w[FS_DUUV] = f2 * (2 * p[FS_DU] + p[FS_DV]) + f1 * (p[FS_DUU] + 2 * p[FS_DUV]) + f * p[FS_DUUV];
  w[FS_DUVV] = f2 * (p[FS_DU] + 2 * p[FS_DV]) + f1 * (2 * p[FS_DUV] + p[FS_DVV]) + f * p[FS_DUVV];
  w[FS_DVVV] = 3 * f2 * p[FS_DV] + 3 * f1 * p[FS_DVV] + f * p[FS_DVVV];
}

void fs_gregory_triangle_jet(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x) {
  static const uint8_t inner[3] = {6, 7, 10}; /* points with 2 at corner 0, 1, 2 and 1 at the others */
  static const double none[2] = {0, 0};
  static const double along_u[3][2] = {{1, 0}, {0, -1}, {-1, 1}}, along_v[3][2] = {{0, 1}, {1, -1}, {-1, 0}};
  const double barycentric[5] = {1 - u - v, u, v, 1 - u - v, u};
  const double *point = data + patch->data_start;
  double w[FS_JET_SIZE];
  fs_bezier_triangle_jet(patch, data, u, v, x);
  if (fs_gregory_triangle_numbers(patch) == 0) return;
  for (int c = 0; c < 3; c++) {
    const double *p = point + 3 * inner[c], *q = point + 3 * (15 + c);
    const fs_vec3 difference = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    if (fs_vec3_dot(difference, difference) == 0) continue; /* polynomial, so third derivatives exist at the corner */
    corner_weight(barycentric[c + 1], barycentric[c + 2], w);
    fs_jet_compose(w, along_u[c], along_v[c], none, w);
    for (int k = 0; k < FS_JET_SIZE; k++) x[k] = fs_vec3_add_scaled(x[k], difference, w[k]);
  }
}
