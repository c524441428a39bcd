/* SPDX-License-Identifier: MIT */
/* Single role: arithmetic of polynomials in Bernstein form, without passing through powers of t. [Farouki 2012]

     derivative   q_i = n (p_{i+1} - p_i)
     product      (ab)_r = sum_{i+j=r} C(n,i) C(m,j) / C(n+m,r) a_i b_j
     elevation    product with the constant 1
     Hermite      P_j     = sum_{i<=j} C(j,i) (n-i)!/n! d_i           d_i, e_i: derivatives at 0, at 1
                  P_{n-j} = sum_{i<=j} (-1)^i C(j,i) (n-i)!/n! e_i                                                 */
#include "math/bernstein.h"

#include <string.h>

double fs_binomial(int32_t n, int32_t i) {
  double value = 1;
  if (i < 0 || i > n) return 0;
  if (i > n - i) i = n - i;
  /* After each step the value is C(n, j + 1), an integer, so the division is exact. */
  for (int32_t j = 0; j < i; j++) value = value * (n - j) / (j + 1);
  return value;
}

void fs_bernstein_basis(int32_t degree, double t, int32_t order, double *value) {
  if (order > degree) {
    memset(value, 0, (size_t)(degree + 1) * sizeof *value);
    return;
  }
  value[0] = 1;
  /* B_i^m = t B_{i-1}^{m-1} + (1-t) B_i^{m-1}: sums of positive terms. */
  for (int32_t m = 1; m <= degree - order; m++) {
    value[m] = t * value[m - 1];
    for (int32_t i = m - 1; i > 0; i--) value[i] = t * value[i - 1] + (1 - t) * value[i];
    value[0] *= 1 - t;
  }
  /* (B_i^m)' = m (B_{i-1}^{m-1} - B_i^{m-1}) */
  for (int32_t m = degree - order + 1; m <= degree; m++) {
    value[m] = m * value[m - 1];
    for (int32_t i = m - 1; i > 0; i--) value[i] = m * (value[i - 1] - value[i]);
    value[0] *= -m;
  }
}

void fs_bernstein_differentiate(int32_t degree, int32_t width, const double *p, double *derivative) {
  if (degree == 0) memset(derivative, 0, (size_t)width * sizeof *derivative);
  for (int32_t i = 0; i < degree * width; i++) derivative[i] = degree * (p[i + width] - p[i]);
}

void fs_bernstein_add_product(int32_t n, const double *a, int32_t m, int32_t width, const double *b, double *out) {
  for (int32_t i = 0; i <= n; i++)
    for (int32_t j = 0; j <= m; j++) {
      double factor = a[i] * fs_binomial(n, i) * fs_binomial(m, j) / fs_binomial(n + m, i + j);
      for (int32_t w = 0; w < width; w++) out[(i + j) * width + w] += factor * b[j * width + w];
    }
}

void fs_bernstein_elevate(int32_t degree, int32_t width, const double *p, int32_t to, double *out) {
  memset(out, 0, (size_t)(to + 1) * (size_t)width * sizeof *out);
  for (int32_t i = 0; i <= to - degree; i++)
    for (int32_t j = 0; j <= degree; j++) {
      double factor = fs_binomial(to - degree, i) * fs_binomial(degree, j) / fs_binomial(to, i + j);
      for (int32_t w = 0; w < width; w++) out[(i + j) * width + w] += factor * p[j * width + w];
    }
}

void fs_bernstein_hermite(int32_t width, int32_t n0, const double *at0, int32_t n1, const double *at1, double *out) {
  int32_t n = n0 + n1 - 1;
  memset(out, 0, (size_t)(n + 1) * (size_t)width * sizeof *out);
  for (int32_t j = 0; j < n0 || j < n1; j++) {
    double falling = 1; /* (n-i)!/n! */
    for (int32_t i = 0; i <= j; i++) {
      double factor = fs_binomial(j, i) * falling, sign = i % 2 ? -1 : 1;
      for (int32_t w = 0; w < width; w++) {
        if (j < n0) out[j * width + w] += factor * at0[i * width + w];
        if (j < n1) out[(n - j) * width + w] += sign * factor * at1[i * width + w];
      }
      if (i < n) falling /= n - i;
    }
  }
}
