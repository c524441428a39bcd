/* SPDX-License-Identifier: MIT */
/* Surfaces with known geometry for tests: patches from powers of u and v, and pieces of spheres, cylinders and tori from
   Taylor series of such a degree that their error is below the rounding of doubles. */
#ifndef FS_TEST_ANALYSE_SAMPLES_H
#define FS_TEST_ANALYSE_SAMPLES_H

#include <fairsurf/surface.h>
#include <math.h>
#include <stdlib.h>

/* A polynomial in one parameter: c[0] + c[1] t + … + c[n] t^n. */
typedef struct series {
  int n;
  double c[FS_MAX_DEGREE + 1];
} series;

/* cos(phase + t angle); with the phase shifted by -pi / 2 a sine. */
static inline series sample_cosine(double phase, double angle) {
  series s = {.n = fabs(angle) > 2 ? 26 : 20};
  double factor = 1;
  for (int k = 0; k <= s.n; k++) {
    s.c[k] = factor * cos(phase + 1.5707963267948966 * k);
    factor *= angle / (k + 1);
  }
  return s;
}
static inline series sample_constant(double a) { return (series){0, {a}}; }
static inline series sample_linear(double a, double b) { return (series){1, {a, b}}; }
static inline series sample_affine(series s, double a, double b) { /* a + b s */
  for (int k = 0; k <= s.n; k++) s.c[k] *= b;
  s.c[0] += a;
  return s;
}

/* A surface that grows patch by patch; sample_grown_free frees it. */
static inline fs_surface *sample_empty(void) { return calloc(1, sizeof(fs_surface)); }

static inline double sample_binomial(int n, int k) {
  double value = 1;
  for (int i = 0; i < k; i++) value = value * (n - i) / (i + 1);
  return value;
}

/* Adds the patch with the coordinates c[d][i + (n + 1) j] u^i v^j, without neighbours. */
static inline int sample_add_powers(fs_surface *s, int n, int m, const double *c[3]) {
  int p = s->n_patches++;
  size_t n_points = (size_t)(n + 1) * (size_t)(m + 1);
  s->patch = realloc(s->patch, (size_t)s->n_patches * sizeof *s->patch);
  s->data = realloc(s->data, (s->n_data + 3 * n_points) * sizeof *s->data);
  s->patch[p] = (fs_patch){.kind = FS_PATCH_TENSOR_BEZIER,
                           .n_sides = 4,
                           .degree_u = n,
                           .degree_v = m,
                           .data_start = s->n_data,
                           .face = FS_NONE,
                           .valence = 4,
                           .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
  for (int j = 0; j <= m; j++)
    for (int i = 0; i <= n; i++)
      for (int d = 0; d < 3; d++) {
        double sum = 0;
        for (int l = 0; l <= j; l++)
          for (int k = 0; k <= i; k++)
            sum += sample_binomial(i, k) / sample_binomial(n, k) * sample_binomial(j, l) / sample_binomial(m, l) *
                   c[d][k + (n + 1) * l];
        s->data[s->n_data++] = sum;
      }
  return p;
}

/* Adds the patch (a0(u) b0(v), a1(u) b1(v), a2(u) b2(v)). */
static inline int sample_add_product(fs_surface *s, const series a[3], const series b[3]) {
  int n = 1, m = 1, p;
  double *c[3];
  for (int d = 0; d < 3; d++) n = a[d].n > n ? a[d].n : n, m = b[d].n > m ? b[d].n : m;
  for (int d = 0; d < 3; d++) {
    c[d] = calloc((size_t)(n + 1) * (size_t)(m + 1), sizeof **c);
    for (int j = 0; j <= b[d].n; j++)
      for (int i = 0; i <= a[d].n; i++) c[d][i + (n + 1) * j] = a[d].c[i] * b[d].c[j];
  }
  p = sample_add_powers(s, n, m, (const double *[3]){c[0], c[1], c[2]});
  for (int d = 0; d < 3; d++) free(c[d]);
  return p;
}

/* The graph z = sum c[i + (n + 1) j] x^i y^j over x in [x0, x0 + dx], y in [y0, y0 + dy]. */
static inline int sample_add_graph(fs_surface *s, int n, int m, const double *c, double x0, double dx, double y0,
                                   double dy) {
  size_t n_points = (size_t)(n + 1) * (size_t)(m + 1);
  double *x = calloc(n_points, sizeof *x), *y = calloc(n_points, sizeof *y), *z = calloc(n_points, sizeof *z);
  int p;
  x[0] = x0, x[1] = dx, y[0] = y0, y[n + 1] = dy;
  for (int j = 0; j <= m; j++)
    for (int i = 0; i <= n; i++) /* (x0 + dx u)^i (y0 + dy v)^j */
      for (int l = 0; l <= j; l++)
        for (int k = 0; k <= i; k++)
          z[k + (n + 1) * l] += c[i + (n + 1) * j] * sample_binomial(i, k) * pow(x0, i - k) * pow(dx, k) *
                                sample_binomial(j, l) * pow(y0, j - l) * pow(dy, l);
  p = sample_add_powers(s, n, m, (const double *[3]){x, y, z});
  free(x), free(y), free(z);
  return p;
}

/* Adds the Bezier triangle of degree 2 with these points: rows of 3, 2, 1. */
static inline int sample_add_triangle(fs_surface *s, const double points[18]) {
  int p = s->n_patches++;
  s->patch = realloc(s->patch, (size_t)s->n_patches * sizeof *s->patch);
  s->data = realloc(s->data, (s->n_data + 18) * sizeof *s->data);
  s->patch[p] = (fs_patch){.kind = FS_PATCH_BEZIER_TRIANGLE,
                           .n_sides = 3,
                           .degree_u = 2,
                           .degree_v = 2,
                           .data_start = s->n_data,
                           .face = FS_NONE,
                           .valence = 4,
                           .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
  for (int k = 0; k < 18; k++) s->data[s->n_data++] = points[k];
  return p;
}

/* Turns patch p so that its outside is inside: u and v are exchanged. */
static inline void sample_flip(fs_surface *s, int p) {
  fs_patch *patch = &s->patch[p];
  int n = patch->degree_u, m = patch->degree_v;
  double *b = s->data + patch->data_start, *copy = malloc(3 * (size_t)(n + 1) * (size_t)(m + 1) * sizeof *copy);
  for (int j = 0; j <= m; j++)
    for (int i = 0; i <= n; i++)
      for (int d = 0; d < 3; d++) copy[3 * (j + (m + 1) * i) + d] = b[3 * (i + (n + 1) * j) + d];
  for (int k = 0; k < 3 * (n + 1) * (m + 1); k++) b[k] = copy[k];
  patch->degree_u = m, patch->degree_v = n;
  free(copy);
}

/* Part of a torus about the z axis: angles a0 .. a0 + da along the large circle, b0 .. b0 + db around the tube. A sphere of
   radius r for R = 0. Outside is outside. */
static inline int sample_add_torus(fs_surface *s, double R, double r, double a0, double da, double b0, double db) {
  const double quarter = 1.5707963267948966;
  series ring = sample_affine(sample_cosine(b0, db), R, r);
  return sample_add_product(
      s, (const series[3]){sample_cosine(a0, da), sample_cosine(a0 - quarter, da), sample_constant(1)},
      (const series[3]){ring, ring, sample_affine(sample_cosine(b0 - quarter, db), 0, r)});
}

/* Part of a cylinder about the z axis, from height z0 on, dz high. */
static inline int sample_add_cylinder(fs_surface *s, double r, double a0, double da, double z0, double dz) {
  return sample_add_product(s,
                            (const series[3]){sample_affine(sample_cosine(a0, da), 0, r),
                                              sample_affine(sample_cosine(a0 - 1.5707963267948966, da), 0, r),
                                              sample_constant(1)},
                            (const series[3]){sample_constant(1), sample_constant(1), sample_linear(z0, dz)});
}

static inline void sample_grown_free(fs_surface *s) {
  free(s->patch);
  free(s->data);
  free(s);
}

#endif
