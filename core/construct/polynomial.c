/* SPDX-License-Identifier: MIT */
/* Single role: products, one division, and signs of polynomials in Bernstein form.

     division: f = sum_k f_k C(n, k) t^k (1 - t)^(n-k), so t^2 (1 - t)^2 divides it if f_0 = f_1 = f_(n-1) = f_n = 0, and
     q_k = f_(k+2) C(n, k + 2) / C(n - 4, k).
     sign: coefficients of one sign bound the values away from 0; else both halves are tried [Farouki 2012]. */
#include "construct/polynomial.h"
#include "math/bernstein.h"

#include <math.h>
#include <string.h>

enum { MAX_DEGREE = 31, MAX_DEPTH = 20 };

void fs_polynomial_cross(int32_t n, const double *a, int32_t m, const double *b, double *out) {
  memset(out, 0, 3 * (size_t)(n + m + 1) * sizeof *out);
  for (int32_t i = 0; i <= n; i++)
    for (int32_t j = 0; j <= m; j++) {
      double weight = fs_binomial(n, i) * fs_binomial(m, j) / fs_binomial(n + m, i + j);
      for (int w = 0; w < 3; w++) {
        int u = (w + 1) % 3, v = (w + 2) % 3;
        out[3 * (i + j) + w] += weight * (a[3 * i + u] * b[3 * j + v] - a[3 * i + v] * b[3 * j + u]);
      }
    }
}

void fs_polynomial_dot(int32_t n, const double *a, int32_t m, const double *b, double *out) {
  memset(out, 0, (size_t)(n + m + 1) * sizeof *out);
  for (int32_t i = 0; i <= n; i++)
    for (int32_t j = 0; j <= m; j++) {
      double weight = fs_binomial(n, i) * fs_binomial(m, j) / fs_binomial(n + m, i + j);
      for (int w = 0; w < 3; w++) out[i + j] += weight * a[3 * i + w] * b[3 * j + w];
    }
}

double fs_polynomial_size(int32_t n, const double *c) {
  double size = 0;
  for (int32_t i = 0; i < n; i++) size = fmax(size, fabs(c[i]));
  return size;
}

double fs_polynomial_divide_ends(int32_t n, const double *f, double *quotient) {
  for (int32_t k = 0; k <= n - 4; k++) quotient[k] = f[k + 2] * fs_binomial(n, k + 2) / fs_binomial(n - 4, k);
  return fmax(fs_polynomial_size(2, f), fs_polynomial_size(2, f + n - 1));
}

/* c becomes its part on [0, 1/2], right that on [1/2, 1]. */
static void split(int32_t degree, double *c, double *right) {
  for (int32_t r = 0; r <= degree; r++) {
    right[degree - r] = c[degree];
    for (int32_t i = degree; i > r; i--) c[i] = (c[i - 1] + c[i]) / 2;
  }
}

static int decide(int32_t degree, const double *c, int depth, double from, double to, double *at) {
  double left[MAX_DEGREE + 1], right[MAX_DEGREE + 1];
  double low = c[0], high = c[0];
  int first, second;
  for (int32_t i = 1; i <= degree; i++) low = fmin(low, c[i]), high = fmax(high, c[i]);
  if (low > 0) return 1;
  if (high < 0) return -1;
  if (depth == 0 || !(c[0] * c[degree] > 0)) {
    *at = fabs(c[0]) < fabs(c[degree]) ? from : to;
    return 0;
  }
  memcpy(left, c, (size_t)(degree + 1) * sizeof *c);
  split(degree, left, right);
  first = decide(degree, left, depth - 1, from, (from + to) / 2, at);
  if (first == 0) return 0;
  second = decide(degree, right, depth - 1, (from + to) / 2, to, at);
  return second;
}

int fs_polynomial_sign(int32_t degree, const double *c, double *at) {
  return degree > MAX_DEGREE ? 0 : decide(degree, c, MAX_DEPTH, 0, 1, at);
}
