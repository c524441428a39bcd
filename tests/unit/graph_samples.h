/* SPDX-License-Identifier: MIT */
/* Graphs over [-1, 1]^2 as four bicubic patches. */
#ifndef FS_TEST_GRAPH_SAMPLES_H
#define FS_TEST_GRAPH_SAMPLES_H

#include <fairsurf/surface.h>
#include <string.h>

typedef struct graph {
  double c30, c12; /* z = (x^2 + y^2) / 2 + c30 x^3 + c12 x y^2 */
} graph;

/* Blossom of x^k over x = a + t (b - a), of degree 3, at i ones: symmetric mean of products. */
static inline double blossom(int k, double a, double b, int i) {
  double arg[3], e[4] = {1, 0, 0, 0};
  static const double binomial[4] = {1, 3, 3, 1};
  for (int n = 0; n < 3; n++) arg[n] = n < i ? b : a;
  for (int n = 0; n < 3; n++)
    for (int m = 3; m > 0; m--) e[m] += arg[n] * e[m - 1];
  return e[k] / binomial[k];
}

static inline void make_graph(graph g, fs_patch patch[4], double *data, fs_surface *surface) {
  memset(patch, 0, 4 * sizeof *patch);
  for (int p = 0; p < 4; p++) {
    double x0 = p % 2 - 1.0, y0 = p / 2 - 1.0;
    patch[p] = (fs_patch){.kind = FS_PATCH_TENSOR_BEZIER,
                          .n_sides = 4,
                          .degree_u = 3,
                          .degree_v = 3,
                          .data_start = (size_t)(48 * p),
                          .face = FS_NONE,
                          .valence = 4,
                          .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
    for (int k = 0; k < 16; k++) {
      double *b = data + 48 * p + 3 * k, X[4], Y[4];
      for (int m = 0; m < 4; m++) X[m] = blossom(m, x0, x0 + 1, k % 4), Y[m] = blossom(m, y0, y0 + 1, k / 4);
      b[0] = X[1], b[1] = Y[1];
      b[2] = 0.5 * (X[2] + Y[2]) + g.c30 * X[3] + g.c12 * X[1] * Y[2];
    }
  }
  static const int beside[4][3] = {{0, 1, 1}, {2, 1, 3}, {0, 2, 2}, {1, 2, 3}}; /* patch, side, neighbour */
  for (int k = 0; k < 4; k++) {
    int p = beside[k][0], s = beside[k][1], q = beside[k][2], r = s == 1 ? 3 : 0;
    patch[p].neighbour[s] = q, patch[p].neighbour_side[s] = (uint8_t)r;
    patch[q].neighbour[r] = p, patch[q].neighbour_side[r] = (uint8_t)s;
  }
  *surface = (fs_surface){.n_patches = 4, .n_data = 192, .patch = patch, .data = data};
}

#endif
