/* SPDX-License-Identifier: MIT */
/* Surfaces for tests, put together from known numbers: grids of bicubic patches of a periodic uniform B-spline, some of
   them raised to degree (9, 9). */
#ifndef FS_TEST_SURFACE_SAMPLES_H
#define FS_TEST_SURFACE_SAMPLES_H

#include <fairsurf/surface.h>
#include <math.h>
#include <stdlib.h>

static fs_vec3 sample_control(int i, int j, int n, int m) {
  double a = 6.283185307179586 * i / n, b = 6.283185307179586 * j / m;
  double r = 0.45 * (1 + 0.15 * sin(3 * a) * cos(2 * b)), R = 1.2 + r * cos(b);
  return (fs_vec3){R * cos(a), R * sin(a), r * sin(b)};
}

/* One segment of a uniform cubic B-spline as Bezier points: b = SEG c. */
static const double sample_segment[4][4] = {
    {1 / 6., 4 / 6., 1 / 6., 0}, {0, 4 / 6., 2 / 6., 0}, {0, 2 / 6., 4 / 6., 0}, {0, 1 / 6., 4 / 6., 1 / 6.}};

static void sample_bicubic(int p, int q, int n, int m, double *b) {
  for (int j = 0; j < 4; j++)
    for (int i = 0; i < 4; i++) {
      double sum[3] = {0, 0, 0};
      for (int l = 0; l < 4; l++)
        for (int k = 0; k < 4; k++) {
          fs_vec3 c = sample_control((p + k) % n, (q + l) % m, n, m);
          double w = sample_segment[i][k] * sample_segment[j][l];
          sum[0] += w * c.x, sum[1] += w * c.y, sum[2] += w * c.z;
        }
      for (int d = 0; d < 3; d++) b[3 * (i + 4 * j) + d] = sum[d];
    }
}

/* Degree elevation of one direction by one: count curves of degree n, stride between points, step between curves. */
static void sample_raise_grid(const double *from, int n, int m, double *to) { /* u: (n, m) -> (n + 1, m) */
  for (int j = 0; j <= m; j++)
    for (int i = 0; i <= n + 1; i++)
      for (int d = 0; d < 3; d++) {
        double s = (double)i / (n + 1);
        double left = i > 0 ? from[3 * (i - 1 + (n + 1) * j) + d] : 0,
               right = i <= n ? from[3 * (i + (n + 1) * j) + d] : 0;
        to[3 * (i + (n + 2) * j) + d] = s * left + (1 - s) * right;
      }
}

static void sample_transpose(const double *from, int n, int m, double *to) {
  for (int j = 0; j <= m; j++)
    for (int i = 0; i <= n; i++)
      for (int d = 0; d < 3; d++) to[3 * (j + (m + 1) * i) + d] = from[3 * (i + (n + 1) * j) + d];
}

/* b[300]: in 16 points of a bicubic, out the 100 of degree (9, 9). */
static void sample_raise(double *b) {
  double a[300], c[300];
  for (int k = 0; k < 48; k++) a[k] = b[k];
  for (int pass = 0; pass < 2; pass++) {
    int m = pass == 0 ? 3 : 9;
    for (int n = 3; n < 9; n++) {
      sample_raise_grid(a, n, m, c);
      for (int k = 0; k < 3 * (n + 2) * (m + 1); k++) a[k] = c[k];
    }
    sample_transpose(a, 9, m, c);
    for (int k = 0; k < 300; k++) a[k] = c[k];
  }
  for (int k = 0; k < 300; k++) b[k] = a[k];
}

/* n x m patches of a bumpy torus, closed in both directions. is_raised(i, j): patch (i, j) has degree (9, 9), and its
   inner points are moved by bump times a pattern, which leaves position, first and second derivatives at its sides. */
static inline fs_surface *sample_torus(int n, int m, int (*is_raised)(int i, int j), double bump) {
  fs_surface *s = calloc(1, sizeof *s);
  s->n_patches = n * m;
  s->patch = calloc((size_t)(n * m), sizeof *s->patch);
  s->data = calloc((size_t)(n * m) * 300, sizeof *s->data);
  for (int j = 0; j < m; j++)
    for (int i = 0; i < n; i++) {
      int p = i + n * j, raised = is_raised != NULL && is_raised(i, j), degree = raised ? 9 : 3;
      double b[300];
      sample_bicubic(i, j, n, m, b);
      if (raised) sample_raise(b);
      for (int l = 3; raised && l < 7; l++)
        for (int k = 3; k < 7; k++) b[3 * (k + 10 * l) + 2] += bump * ((k * l) % 3 - 1);
      s->patch[p] = (fs_patch){.n_sides = 4,
                               .degree_u = degree,
                               .degree_v = degree,
                               .data_start = s->n_data,
                               .face = p,
                               .valence = 4,
                               .neighbour_side = {2, 3, 0, 1}};
      s->patch[p].neighbour[0] = i + n * ((j + m - 1) % m);
      s->patch[p].neighbour[1] = (i + 1) % n + n * j;
      s->patch[p].neighbour[2] = i + n * ((j + 1) % m);
      s->patch[p].neighbour[3] = (i + n - 1) % n + n * j;
      for (int k = 0; k < 3 * (degree + 1) * (degree + 1); k++) s->data[s->n_data++] = b[k];
    }
  return s;
}

static inline void sample_free(fs_surface *s) {
  free(s->patch);
  free(s->data);
  free(s);
}

#endif
