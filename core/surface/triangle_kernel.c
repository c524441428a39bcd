/* SPDX-License-Identifier: MIT */
/* Single role: Bezier triangles at vectors of points, with derivatives to order 3, by de Casteljau's steps (formulas as in
   kind_bezier_triangle.c). */
#include "math/lanes.h"
#include "surface/points.h"

#include <fairsurf/surface.h>

enum { MAX_POINTS = (FS_MAX_DEGREE + 1) * (FS_MAX_DEGREE + 2) / 2 };

typedef lanes point[3];

/* Number of point j of row k in a net of degree n. */
static inline int32_t number(int32_t n, int32_t j, int32_t k) { return j + k * (2 * n + 3 - k) / 2; }

/* The net of degree n becomes that of degree n - 1, in place: rows move towards the front only. */
static inline void step(point *net, int32_t n, lanes a, lanes u, lanes v) {
  for (int32_t k = 0; k < n; k++)
    for (int32_t j = 0; j < n - k; j++)
      for (int c = 0; c < 3; c++)
        net[number(n - 1, j, k)][c] =
            a * net[number(n, j, k)][c] + u * net[number(n, j + 1, k)][c] + v * net[number(n, j, k + 1)][c];
}

/* x[0 .. order]: derivatives of that order, fewest by v first, from the net of degree = order. */
static inline void set_derivatives(const point *net, int32_t order, double factor, point *x) {
  for (int32_t n_v = 0; n_v <= order; n_v++)
    for (int c = 0; c < 3; c++) {
      lanes d[10];
      for (int32_t i = 0; i < (order + 1) * (order + 2) / 2; i++) d[i] = net[i][c];
      for (int32_t n = order; n > 0; n--) {
        int32_t is_v = n <= n_v;
        for (int32_t k = 0; k < n; k++)
          for (int32_t j = 0; j < n - k; j++)
            d[number(n - 1, j, k)] = d[number(n, j + 1 - is_v, k + is_v)] - d[number(n, j, k)];
      }
      x[n_v][c] = factor * d[0];
    }
}

static inline __attribute__((always_inline)) void evaluate(int32_t degree, const double *b, lanes u, lanes v,
                                                           point *x) {
  static const int32_t first[4] = {FS_D, FS_DU, FS_DUU, FS_DUUU};
  point net[MAX_POINTS];
  for (int32_t i = 0; i < (degree + 1) * (degree + 2) / 2; i++)
    for (int c = 0; c < 3; c++) net[i][c] = lanes_spread(b[3 * i + c]);
  for (int32_t n = degree; n > 3; n--) step(net, n, 1 - u - v, u, v);
  for (int32_t order = 3; order >= 0; order--) {
    double factor = 1; /* degree! / (degree - order)!, which is 0 above the degree */
    for (int32_t i = 0; i < order; i++) factor *= degree - i;
    if (order <= degree) {
      set_derivatives((const point *)net, order, factor, x + first[order]);
      if (order > 0) step(net, order, 1 - u - v, u, v);
    } else {
      for (int32_t i = 0; i <= order; i++)
        for (int c = 0; c < 3; c++) x[first[order] + i][c] = (lanes){0};
    }
  }
}

/* The last vector is filled up with its first point. */
static inline __attribute__((always_inline)) void run(int32_t degree, const double *b, int32_t n_derivatives, size_t n,
                                                      const double *u, const double *v, double *out) {
  for (size_t i = 0; i < n; i += FS_LANES) {
    size_t count = n - i < FS_LANES ? n - i : FS_LANES;
    double some_u[FS_LANES], some_v[FS_LANES];
    point x[FS_JET_SIZE];
    for (size_t l = 0; l < FS_LANES; l++)
      some_u[l] = u[i + (l < count ? l : 0)], some_v[l] = v[i + (l < count ? l : 0)];
    evaluate(degree, b, lanes_load(some_u), lanes_load(some_v), x);
    for (int32_t k = 0; k < n_derivatives; k++)
      for (int c = 0; c < 3; c++) memcpy(out + (size_t)(3 * k + c) * n + i, &x[k][c], count * sizeof(double));
  }
}

void FS_KERNEL(fs_points_triangle)(int32_t degree, const double *b, int32_t n_derivatives, size_t n, const double *u,
                                   const double *v, double *out);
void FS_KERNEL(fs_points_triangle)(int32_t degree, const double *b, int32_t n_derivatives, size_t n, const double *u,
                                   const double *v, double *out) {
  if (degree == 3) /* with its own loops, of constant length */
    run(3, b, n_derivatives, n, u, v, out);
  else
    run(degree, b, n_derivatives, n, u, v, out);
}
