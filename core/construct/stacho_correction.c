/* SPDX-License-Identifier: MIT */
/* Single role: the correction that makes two triangles of Stacho tangent along their common edge.

   With t the barycentric coordinate of one end of the edge, in both triangles:
     E(t)      the edge curve,   D(t), D'(t)  derivatives to the inside of one and of the other triangle, from
               D = n sum_m B_m^(n-1) (r1_m - (r0_m + r0_(m+1)) / 2), r0 and r1 the rows of control points of the edge
     N = E' x (D - D'),   det = (E' x D) . D',   delta = det / (t^2 (1 - t)^2),   V = - delta W / (N . W)
   Both triangles get c a^2 b^2 V, which adds t^2 (1 - t)^2 V to D and to D'. Then D and D' are orthogonal to N as E' is:
   D . N = D' . N = det. The division has no remainder, for at each end all first derivatives lie in one plane.
   [Stacho 2025 proves that such a correction exists; docs/stacho.md. Differs: rational of the least length, the same sign
   on both sides.] */
#include "construct/stacho.h"
#include "construct/polynomial.h"
#include "math/bernstein.h"
#include "math/triangle.h"
#include "surface/stacho.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { MAX = FS_STACHO_HIGHEST, N_SAMPLES = 33 };

typedef struct edge {
  int32_t n;
  double E1[3 * MAX], D[2][3 * MAX]; /* of degree n - 1 */
  double N[3 * (2 * MAX - 1)];       /* of degree 2 n - 2 */
  double det[3 * MAX - 2];           /* of degree 3 n - 3 */
  double delta[3 * MAX - 6];         /* of degree 3 n - 7 */
} edge;

static void reverse(int32_t n, int32_t width, double *c) {
  for (int32_t i = 0; i < n / 2; i++)
    for (int32_t w = 0; w < width; w++) {
      double kept = c[i * width + w];
      c[i * width + w] = c[(n - 1 - i) * width + w];
      c[(n - 1 - i) * width + w] = kept;
    }
}

/* E' and D along a side, t the coordinate of its first corner. */
static void set_derivatives(int32_t n, const fs_stacho_half *half, double *E1, double *D) {
  double row0[3 * (MAX + 1)], row1[3 * MAX];
  fs_triangle_edge_rows(n, 3, half->numbers, (half->side + 2) % 3, row0, row1);
  fs_bernstein_differentiate(n, 3, row0, E1);
  for (int32_t i = 0; i < 3 * n; i++) D[i] = n * (row1[i] - (row0[i] + row0[i + 3]) / 2);
}

static void set_edge(int32_t n, const fs_stacho_half half[2], edge *e) {
  double other[3 * MAX], difference[3 * MAX], normal[3 * (2 * MAX - 1)];
  e->n = n;
  set_derivatives(n, &half[0], e->E1, e->D[0]);
  set_derivatives(n, &half[1], other, e->D[1]);
  reverse(n, 3, e->D[1]); /* the other triangle runs along the edge the other way */
  for (int32_t i = 0; i < 3 * n; i++) difference[i] = e->D[0][i] - e->D[1][i];
  fs_polynomial_cross(n - 1, e->E1, n - 1, difference, e->N);
  fs_polynomial_cross(n - 1, e->E1, n - 1, e->D[0], normal);
  fs_polynomial_dot(2 * n - 2, normal, n - 1, e->D[1], e->det);
}

/* Whether (E' x D) . N has the sign of direction (1: D, -1: D') all along; else at is a parameter where it has not. */
static bool keeps_side(const edge *e, int which, double *at) {
  double normal[3 * (2 * MAX - 1)], f[4 * MAX - 3], basis[4 * MAX - 3];
  int32_t n = e->n, degree = 4 * n - 4;
  double least = 1e-9 * fs_polynomial_size(3 * (2 * n - 1), e->N);
  fs_polynomial_cross(n - 1, e->E1, n - 1, e->D[which], normal);
  least *= fs_polynomial_size(3 * (2 * n - 1), normal);
  fs_polynomial_dot(2 * n - 2, normal, 2 * n - 2, e->N, f);
  if (which == 1)
    for (int32_t i = 0; i <= degree; i++) f[i] = -f[i];
  if (fs_polynomial_sign(degree, f, at) == 1) return true;
  for (int i = 0; i < N_SAMPLES; i++) {
    double t = (double)i / (N_SAMPLES - 1), value = 0;
    fs_bernstein_basis(degree, t, 0, basis);
    for (int32_t k = 0; k <= degree; k++) value += basis[k] * f[k];
    if (value > least) continue;
    *at = t;
    return false;
  }
  return true;
}

static bool keeps_direction(const edge *e, const double *fixed, double *at) {
  double f[2 * MAX - 1];
  int32_t degree = 2 * e->n - 2;
  for (int32_t i = 0; i <= degree; i++)
    f[i] = e->N[3 * i] * fixed[0] + e->N[3 * i + 1] * fixed[1] + e->N[3 * i + 2] * fixed[2];
  return fs_polynomial_sign(degree, f, at) != 0;
}

static fs_status check(fs_context *ctx, const edge *e, const fs_stacho_half half[2], int32_t a, int32_t b,
                       const double *fixed) {
  double at = 0;
  for (int which = 0; which < 2; which++)
    if (!keeps_side(e, which, &at))
      return fs_fail(
          ctx, FS_ERR_NUMERIC,
          "triangles %d and %d do not lie on opposite sides of the edge between vertices %d and %d, near its "
          "parameter %.3g from vertex %d: their normals turn too far for one tangent plane",
          (int)half[0].face, (int)half[1].face, (int)a, (int)b, 1 - at, (int)a);
  if (fixed != NULL && !keeps_direction(e, fixed, &at))
    return fs_fail(
        ctx, FS_ERR_NUMERIC,
        "the sum of the normals at vertices %d and %d lies in the tangent plane of their edge: corrections of "
        "a fixed direction do not exist there",
        (int)a, (int)b);
  return FS_OK;
}

static void write_block(const edge *e, const double *fixed, bool is_reversed, double *block) {
  int32_t n = e->n;
  double *N = block + fs_stacho_n(n);
  block[FS_STACHO_IS_CORRECTED] = 1;
  block[FS_STACHO_IS_FIXED] = fixed != NULL;
  for (int w = 0; w < 3 && fixed != NULL; w++) block[FS_STACHO_W + w] = fixed[w];
  memcpy(block + FS_STACHO_DELTA, e->delta, (size_t)(3 * n - 6) * sizeof *block);
  memcpy(N, e->N, 3 * (size_t)(2 * n - 1) * sizeof *block);
  if (!is_reversed) return;
  reverse(3 * n - 6, 1, block + FS_STACHO_DELTA);
  reverse(2 * n - 1, 3, N);
}

/* How far det may be wrong: differences of control points are by some units in the last place of the points. */
static double rounding(const edge *e, const fs_stacho_half half[2]) {
  int32_t n = e->n;
  double E = fs_polynomial_size(3 * n, e->E1), D = fs_polynomial_size(3 * n, e->D[0]), other, point;
  other = fs_polynomial_size(3 * n, e->D[1]);
  point = fs_polynomial_size(3 * fs_triangle_size(n), half[0].numbers);
  return 64 * DBL_EPSILON * n * point * (E * D + E * other + D * other);
}

fs_status fs_stacho_correct(fs_context *ctx, int32_t n, const fs_stacho_half half[2], int32_t a, int32_t b,
                            const double *fixed) {
  fs_status status;
  edge e;
  double remainder;
  set_edge(n, half, &e);
  status = check(ctx, &e, half, a, b, fixed);
  if (status != FS_OK) return status;
  remainder = fs_polynomial_divide_ends(3 * n - 3, e.det, e.delta);
  if (!(remainder <= 1e-9 * fs_polynomial_size(3 * n - 2, e.det) + rounding(&e, half)))
    return fs_fail(
        ctx, FS_ERR_NUMERIC,
        "the tangents of triangles %d and %d at the edge between vertices %d and %d do not lie in one plane at "
        "its ends",
        (int)half[0].face, (int)half[1].face, (int)a, (int)b);
  for (int which = 0; which < 2; which++)
    write_block(&e, fixed, which == 1, half[which].numbers + fs_stacho_side(n, half[which].side));
  return FS_OK;
}
