/* SPDX-License-Identifier: MIT */
/* Bicubic stand-ins for patches of other degrees.

   On a grid of 2^m x 2^m cells of width h every cell gets the bicubic Hermite interpolant of position, S_u, S_v, S_uv at
   its four corners. The Bezier point next to a corner in the directions (s, t), each 0 or +-1 towards the inside, is
     S + s (h / 3) S_u + t (h / 3) S_v + s t (h^2 / 9) S_uv   [Farin 2002, 16.9].
   Neighbouring cells share position and derivatives along their side, hence C1; the error falls as h^4. */
#include "surface/surface.h"
#include "math/vec3.h"

void fs_hermite_corner(const fs_vec3 *x, double h, int corner_u, int corner_v, fs_vec3 *piece) {
  double su = corner_u ? -1 : 1, sv = corner_v ? -1 : 1;
  for (int t = 0; t < 2; t++)
    for (int s = 0; s < 2; s++) {
      fs_vec3 b = x[FS_D];
      if (s) b = fs_vec3_add_scaled(b, x[FS_DU], su * h / 3);
      if (t) b = fs_vec3_add_scaled(b, x[FS_DV], sv * h / 3);
      if (s && t) b = fs_vec3_add_scaled(b, x[FS_DUV], su * sv * h * h / 9);
      int i = corner_u ? 3 - s : s, j = corner_v ? 3 - t : t;
      piece[i + 4 * j] = b;
    }
}

void fs_surface_hermite_bicubics(const fs_surface *surface, int32_t patch, int32_t m, fs_vec3 *bezier) {
  int32_t n = (int32_t)1 << m;
  double h = 1.0 / n;
  fs_vec3 x[FS_JET_SIZE];
  for (int32_t b = 0; b <= n; b++)
    for (int32_t a = 0; a <= n; a++) {
      fs_surface_evaluate(surface, patch, a * h, b * h, x);
      for (int corner_v = 0; corner_v < 2; corner_v++)
        for (int corner_u = 0; corner_u < 2; corner_u++) {
          int32_t i = a - corner_u, j = b - corner_v; /* the cell of which this node is that corner */
          if (i < 0 || j < 0 || i >= n || j >= n) continue;
          fs_hermite_corner(x, h, corner_u, corner_v, bezier + 16 * ((size_t)i + (size_t)n * (size_t)j));
        }
    }
}

fs_vec3 fs_bicubic_point(const fs_vec3 *piece, double u, double v) {
  const double p = 1 - u, q = 1 - v;
  const double B[4] = {p * p * p, 3 * p * p * u, 3 * p * u * u, u * u * u};
  const double C[4] = {q * q * q, 3 * q * q * v, 3 * q * v * v, v * v * v};
  fs_vec3 sum = {0, 0, 0};
  for (int j = 0; j < 4; j++)
    for (int i = 0; i < 4; i++) sum = fs_vec3_add_scaled(sum, piece[i + 4 * j], B[i] * C[j]);
  return sum;
}

/* Largest distance between patch and pieces at 8x8 points per piece, away from the corners where it is zero. Ends early
   above enough. */
static double measure(const fs_surface *surface, int32_t patch, int32_t m, const fs_vec3 *bezier, double enough) {
  enum { N = 8 };
  int32_t n = (int32_t)1 << m;
  double largest = 0;
  fs_vec3 x[FS_JET_SIZE];
  for (int32_t j = 0; j < N * n; j++)
    for (int32_t i = 0; i < N * n; i++) {
      double u = (i % N + 0.5) / N, v = (j % N + 0.5) / N;
      const fs_vec3 *piece = bezier + 16 * ((size_t)(i / N) + (size_t)n * (size_t)(j / N));
      fs_surface_evaluate(surface, patch, (i + 0.5) / (N * n), (j + 0.5) / (N * n), x);
      double distance = fs_vec3_distance(x[FS_D], fs_bicubic_point(piece, u, v));
      if (!(distance <= largest)) largest = distance;
      if (!(largest <= enough)) return largest;
    }
  return largest;
}

fs_status fs_surface_hermite_depth(fs_context *ctx, const fs_surface *surface, int32_t patch, double tolerance,
                                   int32_t max_m, int32_t *m, double *deviation) {
  fs_status status = FS_OK;
  fs_vec3 *bezier = NULL;
  int32_t depth = 0;
  double largest = 0;
  if (surface->patch[patch].n_sides != 4)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "patch %d has 3 sides: bicubic pieces need 4", (int)patch);
  if (max_m < 0 || max_m > 10)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "a patch can be split 0 to 10 times, not %d", (int)max_m);
  for (;; depth++) {
    fs_release(ctx, bezier);
    FS_ALLOC(ctx, bezier, (size_t)16 << (2 * depth));
    fs_surface_hermite_bicubics(surface, patch, depth, bezier);
    largest = measure(surface, patch, depth, bezier, depth < max_m ? tolerance : (double)INFINITY);
    if (largest <= tolerance || depth == max_m) break;
  }
  if (!isfinite(largest)) {
    status = fs_fail(ctx, FS_ERR_NUMERIC, "patch %d has points that are not finite", (int)patch);
    goto done;
  }
  *m = depth;
  *deviation = largest;
done:
  fs_release(ctx, bezier);
  return status;
}
