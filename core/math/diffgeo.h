/* SPDX-License-Identifier: MIT */
/* Differential geometry of a surface at a point, from the derivatives of its position.

   Derivatives x are numbered as everywhere: x[0] = p, x[1] = p_u, x[2] = p_v, x[3] = p_uu, x[4] = p_uv, x[5] = p_vv,
   x[6] = p_uuu, x[7] = p_uuv, x[8] = p_uvv, x[9] = p_vvv. The normal is that of p_u x p_v; curvatures are positive where
   the surface bends towards its normal, so a sphere seen from outside has H = -1 / radius. */
#ifndef FS_MATH_DIFFGEO_H
#define FS_MATH_DIFFGEO_H

#include <fairsurf/base.h>

/* First and second order geometry. e1, e2, normal are orthonormal and right-handed, e1 along p_u; the second fundamental
   form in that frame is [a b; b c]. */
typedef struct fs_geometry {
  fs_vec3 normal, e1, e2;
  double g11, g12, g22; /* first fundamental form by (u, v) */
  double h11, h12, h22; /* second fundamental form by (u, v) */
  double area;          /* |p_u x p_v| = sqrt(det G) */
  double a, b, c;
  double H, K; /* mean (k1 + k2) / 2 and Gaussian curvature k1 k2 */
} fs_geometry;

typedef struct fs_principal {
  double maximum, minimum;                      /* maximum >= minimum */
  fs_vec3 maximum_direction, minimum_direction; /* unit, tangent, orthogonal; any such pair at an umbilic */
} fs_principal;

/* Unit normal from x[1], x[2]; false (normal untouched) where p_u x p_v vanishes: at most 1e-14 |p_u| |p_v|. */
bool fs_normal_compute(const fs_vec3 *x, fs_vec3 *normal);

/* Uses x[1 .. 5]; false (geometry untouched) where p_u x p_v vanishes. */
bool fs_geometry_compute(const fs_vec3 *x, fs_geometry *geometry);
void fs_geometry_principal(const fs_geometry *geometry, fs_principal *principal);

/* W = J G^-1 B G^-1 J^T with J = [p_u p_v]: symmetric, the same for every parametrisation, zero along the normal. */
void fs_geometry_shape_tensor(const fs_geometry *geometry, double tensor[3][3]);

/* Gradient of H along the surface, a tangent vector; uses x[1 .. 9] and the geometry of the same x. */
fs_vec3 fs_geometry_mean_gradient(const fs_vec3 *x, const fs_geometry *geometry);

#endif
