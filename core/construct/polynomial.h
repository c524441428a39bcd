/* SPDX-License-Identifier: MIT */
/* Products of curves in space in Bernstein form, arrays [degree + 1][3]; formula in math/bernstein.c. */
#ifndef FS_CONSTRUCT_POLYNOMIAL_H
#define FS_CONSTRUCT_POLYNOMIAL_H

#include <stdint.h>

/* out[n + m + 1][3] = a x b, out[n + m + 1] = a . b */
void fs_polynomial_cross(int32_t n, const double *a, int32_t m, const double *b, double *out);
void fs_polynomial_dot(int32_t n, const double *a, int32_t m, const double *b, double *out);

/* quotient[n - 3] = f / (t^2 (1 - t)^2) for f of degree n >= 4 whose two first and two last coefficients vanish; returns
   the largest of their moduli. */
double fs_polynomial_divide_ends(int32_t n, const double *f, double *quotient);

/* Largest modulus of n numbers. */
double fs_polynomial_size(int32_t n, const double *c);

/* Whether a polynomial keeps one strict sign on [0, 1]: 1 or -1; 0 where it has a zero or cannot be decided by 20
   subdivisions. at: a parameter near which it does not; untouched otherwise. */
int fs_polynomial_sign(int32_t degree, const double *c, double *at);

#endif
