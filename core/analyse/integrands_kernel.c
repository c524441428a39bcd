/* SPDX-License-Identifier: MIT */
/* Single role: curvatures and their gradient at vectors of points. With m = p_u x p_v, w = |m|, E, F, G the first form,
   L = m . p_uu, M = m . p_uv, N = m . p_vv, A = E N - 2 F M + G L:

     H   = A / (2 w^3),   H_u = A_u / (2 w^3) - 3 H (m . m_u) / w^2,   |grad H|^2 = H_u^2 / E + (H_v - q H_u)^2 E / w^2
     q   = F / E, and in the orthonormal frame along p_u (as in math/diffgeo.c)
     a   = L / (w E),  b = (M - q L) / w^2,  c = (N - 2 q M + q^2 L) E / w^3;  K = a c - b^2,
     k12 = H +- sqrt((a - c)^2 / 4 + b^2)                                                              [do Carmo 1976, 3-3] */
#include "analyse/integrands.h"
#include "math/lanes.h"

#include <fairsurf/base.h>
#include <fairsurf/surface.h>

typedef struct forms {
  lanes m[3], E, F, G, L, M, N, over_w, over_w2, H;
} forms;

/* Derivative of H by one parameter: d1 = (p_u)', d2 = (p_v)'; uu, uv, vv: derivatives of the second derivatives. */
static inline lanes mean_derivative(const lanes (*x)[3], const forms *f, const lanes *d1, const lanes *d2,
                                    const lanes *uu, const lanes *uv, const lanes *vv) {
  lanes m[3];
  lanes_cross(m, d1, x[FS_DV]);
  lanes_add_cross(m, x[FS_DU], d2);
  lanes E = 2 * lanes_dot(d1, x[FS_DU]), F = lanes_dot(d1, x[FS_DV]) + lanes_dot(x[FS_DU], d2);
  lanes G = 2 * lanes_dot(d2, x[FS_DV]);
  lanes L = lanes_dot(m, x[FS_DUU]) + lanes_dot(f->m, uu), M = lanes_dot(m, x[FS_DUV]) + lanes_dot(f->m, uv);
  lanes N = lanes_dot(m, x[FS_DVV]) + lanes_dot(f->m, vv);
  lanes A = E * f->N + f->E * N - 2 * (F * f->M + f->F * M) + G * f->L + f->G * L;
  return (0.5 * A * f->over_w - 3 * f->H * lanes_dot(f->m, m)) * f->over_w2;
}

static inline void evaluate(const lanes (*x)[3], lanes *out) {
  forms f;
  lanes_cross(f.m, x[FS_DU], x[FS_DV]);
  f.E = lanes_dot(x[FS_DU], x[FS_DU]), f.F = lanes_dot(x[FS_DU], x[FS_DV]), f.G = lanes_dot(x[FS_DV], x[FS_DV]);
  f.L = lanes_dot(f.m, x[FS_DUU]), f.M = lanes_dot(f.m, x[FS_DUV]), f.N = lanes_dot(f.m, x[FS_DVV]);
  lanes w2 = lanes_dot(f.m, f.m), w = lanes_sqrt(w2);
  out[FS_AT_AREA] = w;
  out[FS_AT_VOLUME] = lanes_dot(x[FS_D], f.m) * (1.0 / 3);
  for (int l = 0; l < FS_LANES; l++)
    if (!(w2[l] > 1e-28 * f.E[l] * f.G[l])) w[l] = NAN;
  f.over_w = 1 / w;
  f.over_w2 = f.over_w * f.over_w;
  lanes over_E = 1 / f.E, q = f.F * over_E;
  lanes a = f.L * f.over_w * over_E, b = (f.M - q * f.L) * f.over_w2;
  lanes c = (f.N - 2 * q * f.M + q * q * f.L) * f.E * f.over_w2 * f.over_w, half = 0.5 * (a - c);
  lanes radius = lanes_sqrt(half * half + b * b);
  f.H = 0.5 * (a + c);
  lanes H_u = mean_derivative(x, &f, x[FS_DUU], x[FS_DUV], x[FS_DUUU], x[FS_DUUV], x[FS_DUVV]);
  lanes H_v = mean_derivative(x, &f, x[FS_DUV], x[FS_DVV], x[FS_DUUV], x[FS_DUVV], x[FS_DVVV]);
  lanes across = H_v - q * H_u;
  out[FS_AT_H] = f.H;
  out[FS_AT_K] = a * c - b * b;
  out[FS_AT_GRADIENT] = lanes_sqrt(H_u * H_u * over_E + across * across * f.E * f.over_w2);
  out[FS_AT_MAXIMUM] = f.H + radius;
  out[FS_AT_MINIMUM] = f.H - radius;
}

void FS_KERNEL(fs_integrands_at)(size_t n, const double *jets, double *out);
void FS_KERNEL(fs_integrands_at)(size_t n, const double *jets, double *out) {
  for (size_t i = 0; i < n; i += FS_LANES) {
    lanes x[FS_JET_SIZE][3], y[FS_AT_N];
    for (size_t k = 0; k < 3 * FS_JET_SIZE; k++) x[k / 3][k % 3] = lanes_load(jets + k * n + i);
    evaluate((const lanes(*)[3])x, y);
    for (size_t k = 0; k < FS_AT_N; k++) lanes_store(out + k * n + i, y[k]);
  }
}

typedef long long bits __attribute__((vector_size(8 * FS_LANES)));

static inline lanes where_finite(lanes x, lanes y) { return (lanes)((bits)(x - x == 0) & (bits)y); }
static inline lanes absolute(lanes x) { return (lanes)((bits)x & (INT64_MAX - (bits){0})); }

void FS_KERNEL(fs_integrands_add_up)(int32_t n, const double *weight, const double *scale, const double *at,
                                     fs_cell_sums *sums);
void FS_KERNEL(fs_integrands_add_up)(int32_t n, const double *weight, const double *scale, const double *at,
                                     fs_cell_sums *sums) {
  const size_t stride = (size_t)n * (size_t)n;
  lanes size[FS_N_INTEGRALS] = {{0}};
  for (int k = 0; k < FS_N_INTEGRALS; k++)
    for (int32_t i = 0; i < n; i++) sums->by_a[k][i] = 0;
  for (int32_t j = 0; j < n; j++) {
    lanes row[FS_N_INTEGRALS] = {{0}};
    for (int32_t i = 0; i < n; i += FS_LANES) {
      const double *from = at + (size_t)(n * j + i);
      lanes area = lanes_load(from + FS_AT_AREA * stride) * lanes_load(scale + i);
      lanes H = lanes_load(from + FS_AT_H * stride), gradient = lanes_load(from + FS_AT_GRADIENT * stride);
      lanes f[FS_N_INTEGRALS], w = lanes_load(weight + i);
      f[FS_AREA] = area;
      f[FS_VOLUME] = lanes_load(from + FS_AT_VOLUME * stride) * lanes_load(scale + i);
      f[FS_WILLMORE] = where_finite(H, H * H * area);
      f[FS_S] = where_finite(gradient, gradient * gradient * area);
      for (int k = 0; k < FS_N_INTEGRALS; k++) {
        row[k] += w * f[k];
        size[k] += weight[j] * w * absolute(f[k]);
        lanes_store(&sums->by_a[k][i], lanes_load(&sums->by_a[k][i]) + weight[j] * f[k]);
      }
    }
    for (int k = 0; k < FS_N_INTEGRALS; k++) sums->by_b[k][j] = lanes_sum(row[k]);
  }
  for (int k = 0; k < FS_N_INTEGRALS; k++) {
    sums->size[k] = lanes_sum(size[k]);
    sums->integral[k] = 0;
    for (int32_t j = 0; j < n; j++) sums->integral[k] += weight[j] * sums->by_b[k][j];
  }
}
