/* SPDX-License-Identifier: MIT */
/* Single role: linear substitution in homogeneous polynomials of two variables. It serves both polynomials around the
   centre of a cap and symbols of differential operators. */
#include "space/g2cap_parts.h"

#include <string.h>

enum { MAX_DEGREE = 4 };

/* p [degree + 2] *= (t[0] x + t[1] y), in place */
static void multiply_linear(int32_t degree, const double t[2], double *p) {
  p[degree + 1] = t[1] * p[degree];
  for (int32_t j = degree; j > 0; j--) p[j] = t[0] * p[j] + t[1] * p[j - 1];
  p[0] *= t[0];
}

void fs_g2cap_substitute(int32_t degree, const double *a, const double X[2], const double Y[2], double *out) {
  double sum[MAX_DEGREE + 1] = {0};
  for (int32_t j = 0; j <= degree; j++) {
    double p[MAX_DEGREE + 1] = {a[j]}; /* a_j X^(degree-j) Y^j */
    for (int32_t factor = 0; factor < degree; factor++) multiply_linear(factor, factor < degree - j ? X : Y, p);
    for (int32_t i = 0; i <= degree; i++) sum[i] += p[i];
  }
  memcpy(out, sum, (size_t)(degree + 1) * sizeof *out);
}
