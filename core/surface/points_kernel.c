/* SPDX-License-Identifier: MIT */
/* Single role: bicubic and Gregory patches at vectors of points (formulas as in kind_tensor_bezier.c, kind_gregory_quad.c and
   gregory.h), and what their jets say about bending: with n = p_u x p_v, w = |n|, E, F, G the first and L, M, N = n . p_uu,
   n . p_uv, n . p_vv,
     K = (L N - M^2) / w^4,  H = (E N - 2 F M + G L) / (2 w^3). */
#include "math/lanes.h"
#include "surface/points.h"

#include <fairsurf/surface.h>

/* value[order][i]: derivatives of the cubic Bernstein polynomials */
static inline void bernstein(lanes t, int32_t order, lanes value[3][4]) {
  lanes s = 1 - t, st = s * t, ss = s * s, tt = t * t;
  value[0][0] = ss * s, value[0][1] = 3 * ss * t, value[0][2] = 3 * tt * s, value[0][3] = tt * t;
  if (order < 1) return;
  value[1][0] = -3 * ss, value[1][1] = 3 * ss - 6 * st, value[1][2] = 6 * st - 3 * tt, value[1][3] = 3 * tt;
  if (order < 2) return;
  value[2][0] = 6 * s, value[2][1] = 6 * (t - 2 * s), value[2][2] = 6 * (s - 2 * t), value[2][3] = 6 * t;
}

/* The bicubic part of one coordinate. */
static inline __attribute__((always_inline)) void add_bicubic(const double *point, int32_t order, lanes B[3][4],
                                                              lanes C[3][4], lanes *x) {
  lanes row[3];
  for (int j = 0; j < 4; j++) {
    const double *b = point + 12 * j;
    for (int32_t k = 0; k <= order; k++) row[k] = b[0] * B[k][0] + b[3] * B[k][1] + b[6] * B[k][2] + b[9] * B[k][3];
    x[FS_D] = j == 0 ? row[0] * C[0][0] : x[FS_D] + row[0] * C[0][j];
    if (order < 1) continue;
    x[FS_DU] = j == 0 ? row[1] * C[0][0] : x[FS_DU] + row[1] * C[0][j];
    x[FS_DV] = j == 0 ? row[0] * C[1][0] : x[FS_DV] + row[0] * C[1][j];
    if (order < 2) continue;
    x[FS_DUU] = j == 0 ? row[2] * C[0][0] : x[FS_DUU] + row[2] * C[0][j];
    x[FS_DUV] = j == 0 ? row[1] * C[1][0] : x[FS_DUV] + row[1] * C[1][j];
    x[FS_DVV] = j == 0 ? row[0] * C[2][0] : x[FS_DVV] + row[0] * C[2][j];
  }
}

/* w = 9 (1 - x)^2 (1 - y)^2 phi(x, y) and its derivatives by u and v; sx, sy = dx/du, dy/dv. At x = y = 0 the tiny number
   makes a = b = 1/2, elsewhere it is lost in rounding. */
static inline __attribute__((always_inline)) void corner_weight(lanes x, double sx, lanes y, double sy, int32_t order,
                                                                lanes *w) {
  const double tiny = 1e-300;
  lanes one = 1 / (x + y + 2 * tiny), a = (x + tiny) * one, b = (y + tiny) * one;
  lanes x1 = 1 - x, y1 = 1 - y, f = x1 * x1, g = 9 * (y1 * y1), f1 = -2 * x1, g1 = -18 * y1;
  lanes phi = x * y * a;
  w[FS_D] = f * g * phi;
  if (order < 1) return;
  lanes phi_x = (x + 2 * y) * a * b, phi_y = x * a * a;
  lanes f_phi_x = f1 * phi + f * phi_x;
  w[FS_DU] = sx * (g * f_phi_x);
  w[FS_DV] = sy * (f * (g1 * phi + g * phi_y));
  if (order < 2) return;
  lanes aa = a * a;
  w[FS_DUU] = g * (2 * phi + 2 * f1 * phi_x + f * (2 * b * b * b));
  w[FS_DUV] = (sx * sy) * (g1 * f_phi_x + g * (f1 * phi_y + f * (aa * (a + 3 * b))));
  w[FS_DVV] = f * (18 * phi + 2 * g1 * phi_y + g * (-2 * (aa * a)));
}

/* x[1, 3 or 6][3] */
static inline __attribute__((always_inline)) void evaluate(const double *point, double difference[4][3], int is_gregory,
                                                           int32_t order, lanes u, lanes v, lanes (*x)[3]) {
  static const int n_derivatives[3] = {1, 3, 6};
  lanes B[3][4], C[3][4], w[4][6];
  bernstein(u, order, B);
  bernstein(v, order, C);
  if (is_gregory) {
    corner_weight(u, 1, v, 1, order, w[0]);
    corner_weight(1 - u, -1, v, 1, order, w[1]);
    corner_weight(u, 1, 1 - v, -1, order, w[2]);
    corner_weight(1 - u, -1, 1 - v, -1, order, w[3]);
  }
  for (int d = 0; d < 3; d++) {
    lanes coordinate[6];
    add_bicubic(point + d, order, B, C, coordinate);
    for (int k = 0; k < n_derivatives[order]; k++) {
      if (is_gregory)
        for (int c = 0; c < 4; c++) coordinate[k] += difference[c][d] * w[c][k];
      x[k][d] = coordinate[k];
    }
  }
}

/* All points in vectors; the last one is filled up with its first point. */
static inline __attribute__((always_inline)) void run(const double *point, int is_gregory, int32_t order, size_t n,
                                                      const double *u, const double *v, size_t stride, double *out) {
  static const uint8_t inner[4] = {5, 6, 9, 10};
  static const int n_derivatives[3] = {1, 3, 6};
  double difference[4][3];
  for (int c = 0; c < 4 && is_gregory; c++)
    for (int d = 0; d < 3; d++) difference[c][d] = point[3 * (16 + c) + d] - point[3 * inner[c] + d];
  for (size_t i = 0; i < n; i += FS_LANES) {
    double some_u[FS_LANES], some_v[FS_LANES];
    lanes x[6][3];
    size_t count = n - i < FS_LANES ? n - i : FS_LANES;
    if (count == FS_LANES) {
      evaluate(point, difference, is_gregory, order, lanes_load(u + i), lanes_load(v + i), x);
      for (int k = 0; k < n_derivatives[order]; k++)
        for (int d = 0; d < 3; d++) lanes_store(out + (size_t)(3 * k + d) * stride + i, x[k][d]);
      continue;
    }
    for (size_t l = 0; l < FS_LANES; l++)
      some_u[l] = u[i + (l < count ? l : 0)], some_v[l] = v[i + (l < count ? l : 0)];
    evaluate(point, difference, is_gregory, order, lanes_load(some_u), lanes_load(some_v), x);
    for (int k = 0; k < n_derivatives[order]; k++)
      for (int d = 0; d < 3; d++)
        for (size_t l = 0; l < count; l++) out[(size_t)(3 * k + d) * stride + i + l] = x[k][d][l];
  }
}

void FS_KERNEL(fs_points_quad)(const double *point, int is_gregory, int32_t order, size_t n, const double *u,
                               const double *v, size_t stride, double *out);
void FS_KERNEL(fs_points_quad)(const double *point, int is_gregory, int32_t order, size_t n, const double *u,
                               const double *v, size_t stride, double *out) {
  /* each with its own loop, free of branches */
  if (is_gregory) {
    if (order == 0) run(point, 1, 0, n, u, v, stride, out);
    if (order == 1) run(point, 1, 1, n, u, v, stride, out);
    if (order == 2) run(point, 1, 2, n, u, v, stride, out);
  } else {
    if (order == 0) run(point, 0, 0, n, u, v, stride, out);
    if (order == 1) run(point, 0, 1, n, u, v, stride, out);
    if (order == 2) run(point, 0, 2, n, u, v, stride, out);
  }
}

/* n = p_u x p_v counts as zero below 1e-14 |p_u| |p_v|: 0 / 0 then. */
static inline void bend(lanes x[6][3], lanes out[8]) {
  lanes normal[3], E = lanes_dot(x[FS_DU], x[FS_DU]), F = lanes_dot(x[FS_DU], x[FS_DV]);
  lanes G = lanes_dot(x[FS_DV], x[FS_DV]);
  lanes_cross(normal, x[FS_DU], x[FS_DV]);
  lanes w2 = lanes_dot(normal, normal);
  for (int l = 0; l < FS_LANES; l++)
    if (!(w2[l] > 1e-28 * E[l] * G[l])) w2[l] = NAN;
  lanes w = lanes_sqrt(w2), inverse = 1 / w;
  lanes L = lanes_dot(normal, x[FS_DUU]), M = lanes_dot(normal, x[FS_DUV]), N = lanes_dot(normal, x[FS_DVV]);
  lanes inverse2 = inverse * inverse, inverse3 = inverse2 * inverse;
  for (int d = 0; d < 3; d++) out[d] = x[FS_D][d], out[3 + d] = normal[d] * inverse;
  out[6] = 0.5 * (E * N - 2 * F * M + G * L) * inverse3;
  out[7] = (L * N - M * M) * (inverse2 * inverse2);
}

void FS_KERNEL(fs_points_bend)(size_t n, size_t stride_in, const double *jets, size_t stride, double *out);
void FS_KERNEL(fs_points_bend)(size_t n, size_t stride_in, const double *jets, size_t stride, double *out) {
  for (size_t i = 0; i < n; i += FS_LANES) {
    size_t count = n - i < FS_LANES ? n - i : FS_LANES;
    lanes x[6][3], y[8];
    if (count == FS_LANES) {
      for (size_t k = 0; k < 18; k++) x[k / 3][k % 3] = lanes_load(jets + k * stride_in + i);
      bend(x, y);
      for (size_t k = 0; k < 8; k++) lanes_store(out + k * stride + i, y[k]);
      continue;
    }
    for (size_t k = 0; k < 18; k++)
      for (size_t l = 0; l < FS_LANES; l++) x[k / 3][k % 3][l] = jets[k * stride_in + i + (l < count ? l : 0)];
    bend(x, y);
    for (size_t k = 0; k < 8; k++)
      for (size_t l = 0; l < count; l++) out[k * stride + i + l] = y[k][l];
  }
}
