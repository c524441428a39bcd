/* SPDX-License-Identifier: MIT */
/* Single role: nodes and weights of Gauss-Legendre quadrature by Newton's method. [Golub Welsch 1969, Davis Rabinowitz
   1984 section 2.7]

     P_0 = 1, P_1 = x, m P_m = (2m-1) x P_{m-1} - (m-1) P_{m-2}     Legendre polynomials on [-1, 1]
     P_n' = n (P_{n-1} - x P_n) / (1 - x^2)
     node x_i: P_n(x_i) = 0, started at cos(pi (i + 3/4) / (n + 1/2)); weight 2 / ((1 - x_i^2) P_n'(x_i)^2)

   A node is kept as its distance h = 1 - x from the nearer end, so that 1 - x^2 = h (2 - h) keeps all its digits. */
#include "math/quadrature.h"

#include <math.h>

/* *value = P_n(1 - h), *slope = d/dx. The differences m (P_m - P_{m-1}) are summed: without cancellation near h = 0. */
static void evaluate_legendre(int32_t n, double h, double *value, double *slope) {
  double p = 1, step = 0; /* P_m and P_m - P_{m-1} */
  for (int32_t m = 1; m <= n; m++) {
    /* P_m - P_{m-1} = ((m-1) (P_{m-1} - P_{m-2}) - (2m-1) h P_{m-1}) / m */
    step = ((m - 1) * step - (2 * m - 1) * h * p) / m;
    p += step;
  }
  *value = p;
  *slope = n * (h * p - step) / (h * (2 - h)); /* P_{n-1} - x P_n = h P_n - (P_n - P_{n-1}) */
}

fs_status fs_gauss_legendre(fs_context *ctx, int32_t n, double *node, double *weight) {
  const double pi = 3.14159265358979323846;
  if (n < 1 || n > FS_GAUSS_MAX_NODES)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "Gauss quadrature needs 1 to %d nodes, not %d", FS_GAUSS_MAX_NODES, n);
  for (int32_t i = 0; i < (n + 1) / 2; i++) {
    double value, slope, half = sin(pi * (i + 0.75) / (2 * n + 1));
    double h = 2 * half * half;                   /* 1 - cos */
    for (int32_t round = 0; round < 6; round++) { /* quadratic convergence from four digits: three would do */
      evaluate_legendre(n, h, &value, &slope);
      h += value / slope;
    }
    if (2 * i + 1 == n) h = 1;
    evaluate_legendre(n, h, &value, &slope);
    node[i] = h / 2;
    node[n - 1 - i] = 1 - h / 2;
    weight[i] = weight[n - 1 - i] = 1 / (h * (2 - h) * slope * slope);
  }
  return FS_OK;
}
