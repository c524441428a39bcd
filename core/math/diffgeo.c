/* SPDX-License-Identifier: MIT */
/* Curvatures of a surface and their gradient at a point.

   With g_ij = p_i . p_j, n = p_u x p_v / |p_u x p_v|, h_ij = p_ij . n the frame e1 = p_u / s, e2 = (p_v - q p_u) / r is
   orthonormal for s = sqrt(g11), q = g12 / g11, r = |p_u x p_v| / s, and the second form in it is
     a = h11 / s^2,  b = (h12 - q h11) / (s r),  c = (h22 - 2 q h12 + q^2 h11) / r^2;  H = (a + c) / 2,  K = a c - b^2.
   [do Carmo 1976, 3-3]. The gradient follows by differentiating H = N / (2 D), N = g11 h22 + g22 h11 - 2 g12 h12,
   D = det G, by u and v, and the Weingarten derivative of n. */
#include "math/diffgeo.h"
#include "math/vec3.h"

enum { P, PU, PV, PUU, PUV, PVV, PUUU, PUUV, PUVV, PVVV };

static const double regular_sine = 1e-14;

bool fs_normal_compute(const fs_vec3 *x, fs_vec3 *normal) {
  fs_vec3 w = fs_vec3_cross(x[PU], x[PV]);
  double area = fs_vec3_length(w);
  if (!(area > regular_sine * fs_vec3_length(x[PU]) * fs_vec3_length(x[PV])) || !isfinite(area)) return false;
  *normal = fs_vec3_scale(w, 1 / area);
  return true;
}

bool fs_geometry_compute(const fs_vec3 *x, fs_geometry *geometry) {
  fs_geometry g;
  if (!fs_normal_compute(x, &g.normal)) return false;
  g.g11 = fs_vec3_dot(x[PU], x[PU]);
  g.g12 = fs_vec3_dot(x[PU], x[PV]);
  g.g22 = fs_vec3_dot(x[PV], x[PV]);
  g.h11 = fs_vec3_dot(x[PUU], g.normal);
  g.h12 = fs_vec3_dot(x[PUV], g.normal);
  g.h22 = fs_vec3_dot(x[PVV], g.normal);
  g.area = fs_vec3_length(fs_vec3_cross(x[PU], x[PV]));
  double s = sqrt(g.g11), q = g.g12 / g.g11, r = g.area / s;
  g.e1 = fs_vec3_scale(x[PU], 1 / s);
  g.e2 = fs_vec3_cross(g.normal, g.e1);
  g.a = g.h11 / g.g11;
  g.b = (g.h12 - q * g.h11) / (s * r);
  g.c = (g.h22 - 2 * q * g.h12 + q * q * g.h11) / (r * r);
  g.H = 0.5 * (g.a + g.c);
  g.K = g.a * g.c - g.b * g.b;
  *geometry = g;
  return true;
}

void fs_geometry_principal(const fs_geometry *g, fs_principal *principal) {
  double half = 0.5 * (g->a - g->c), radius = hypot(half, g->b);
  /* the direction of the larger eigenvalue of [a b; b c] lies at half the angle of (half, b) */
  double angle = 0.5 * atan2(g->b, half);
  fs_vec3 along = fs_vec3_add_scaled(fs_vec3_scale(g->e1, cos(angle)), g->e2, sin(angle));
  principal->maximum = g->H + radius;
  principal->minimum = g->H - radius;
  principal->maximum_direction = along;
  principal->minimum_direction = fs_vec3_cross(g->normal, along);
}

void fs_geometry_shape_tensor(const fs_geometry *g, double tensor[3][3]) {
  const double e1[3] = {g->e1.x, g->e1.y, g->e1.z}, e2[3] = {g->e2.x, g->e2.y, g->e2.z};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      tensor[i][j] = g->a * e1[i] * e1[j] + g->b * (e1[i] * e2[j] + e2[i] * e1[j]) + g->c * e2[i] * e2[j];
}

/* Derivative of H by one parameter: d1 = (p_u)', d2 = (p_v)', second derivatives x, their derivatives third[3]. */
static double mean_derivative(const fs_vec3 *x, const fs_geometry *g, fs_vec3 d1, fs_vec3 d2, const fs_vec3 third[3]) {
  fs_vec3 w = fs_vec3_add(fs_vec3_cross(d1, x[PV]), fs_vec3_cross(x[PU], d2));
  fs_vec3 dn = fs_vec3_scale(fs_vec3_add_scaled(w, g->normal, -fs_vec3_dot(g->normal, w)), 1 / g->area);
  double g11 = 2 * fs_vec3_dot(d1, x[PU]), g22 = 2 * fs_vec3_dot(d2, x[PV]);
  double g12 = fs_vec3_dot(d1, x[PV]) + fs_vec3_dot(x[PU], d2);
  double h11 = fs_vec3_dot(third[0], g->normal) + fs_vec3_dot(x[PUU], dn);
  double h12 = fs_vec3_dot(third[1], g->normal) + fs_vec3_dot(x[PUV], dn);
  double h22 = fs_vec3_dot(third[2], g->normal) + fs_vec3_dot(x[PVV], dn);
  double det = g->area * g->area;
  double dN = g11 * g->h22 + g->g11 * h22 + g22 * g->h11 + g->g22 * h11 - 2 * (g12 * g->h12 + g->g12 * h12);
  double dD = g11 * g->g22 + g->g11 * g22 - 2 * g->g12 * g12;
  return (0.5 * dN - g->H * dD) / det;
}

fs_vec3 fs_geometry_mean_gradient(const fs_vec3 *x, const fs_geometry *g) {
  double Hu = mean_derivative(x, g, x[PUU], x[PUV], (const fs_vec3[]){x[PUUU], x[PUUV], x[PUVV]});
  double Hv = mean_derivative(x, g, x[PUV], x[PVV], (const fs_vec3[]){x[PUUV], x[PUVV], x[PVVV]});
  double s = sqrt(g->g11);
  return fs_vec3_add_scaled(fs_vec3_scale(g->e1, Hu / s), g->e2, (Hv - g->g12 / g->g11 * Hu) * s / g->area);
}
