/* SPDX-License-Identifier: MIT */
/* Polynomials on [0, 1] by their Bernstein coefficients: p(t) = sum_i p_i B_i^n(t), B_i^n(t) = C(n,i) t^i (1-t)^(n-i).
   Coefficients are vectors of width numbers: a polynomial of degree n is an array [n + 1][width]. [Farouki 2012] */
#ifndef FS_MATH_BERNSTEIN_H
#define FS_MATH_BERNSTEIN_H

#include <stdint.h>

/* C(n, i), exact for n <= 54; 0 outside 0 <= i <= n. */
double fs_binomial(int32_t n, int32_t i);

/* value[i] = order-th derivative of B_i^degree at t, i = 0 .. degree; stable on [0, 1], exact at its ends. */
void fs_bernstein_basis(int32_t degree, double t, int32_t order, double *value);

/* derivative[degree][width] = p'; the derivative of a constant is the constant 0, [1][width]. May be p itself. */
void fs_bernstein_differentiate(int32_t degree, int32_t width, const double *p, double *derivative);

/* out[to + 1][width] = the same polynomial written with degree to >= degree. May not be p itself. */
void fs_bernstein_elevate(int32_t degree, int32_t width, const double *p, int32_t to, double *out);

/* out += a b with a scalar polynomial a of degree n and b of degree m; out is [n + m + 1][width]. */
void fs_bernstein_add_product(int32_t n, const double *a, int32_t m, int32_t width, const double *b, double *out);

/* The polynomial of degree n0 + n1 - 1 with the derivatives at0[0 .. n0 - 1] at 0 and at1[0 .. n1 - 1] at 1, each
   [width]; out is [n0 + n1][width]. */
void fs_bernstein_hermite(int32_t width, int32_t n0, const double *at0, int32_t n1, const double *at1, double *out);

#endif
