/* SPDX-License-Identifier: MIT */
/* Polynomials over a triangle by their Bernstein coefficients in barycentric coordinates l0 + l1 + l2 = 1:
     F = sum_(i+j+k=n) n! / (i! j! k!) l0^i l1^j l2^k c_ijk,
   arrays [(n + 1)(n + 2) / 2][width], rows of equal k, j fastest (degree 3, corners 0, 1, 2 at 0, 3, 9):

       9
       7 8
       4 5 6
       0 1 2 3                                                                              [Farin 2002, ch. 17] */
#ifndef FS_MATH_TRIANGLE_H
#define FS_MATH_TRIANGLE_H

#include <stdint.h>

enum { FS_MAX_TRIANGLE_DEGREE = 15 };

static inline int32_t fs_triangle_size(int32_t n) { return (n + 1) * (n + 2) / 2; }

/* Number of the coefficient with exponents j of l1 and k of l2. */
static inline int32_t fs_triangle_index(int32_t n, int32_t j, int32_t k) { return k * (2 * n + 3 - k) / 2 + j; }

/* The same from exponents e[3]; which degree follows. */
static inline int32_t fs_triangle_at(const int32_t e[3]) { return fs_triangle_index(e[0] + e[1] + e[2], e[1], e[2]); }

/* value[width] = the partial derivative of orders d[3] in l0, l1, l2 as independent variables, at l[3]. */
void fs_triangle_evaluate(int32_t n, int32_t width, const double *c, const double l[3], const int32_t d[3],
                          double *value);

/* out[size(n + m)][width] += a b with a scalar a of degree n and b of degree m. */
void fs_triangle_add_product(int32_t n, const double *a, int32_t m, int32_t width, const double *b, double *out);

/* out[size(to)][width] = the same polynomial with degree to >= n. May not be c itself. */
void fs_triangle_elevate(int32_t n, int32_t width, const double *c, int32_t to, double *out);

/* Coefficients of the polynomial f(l_corner) of one variable, f given by Bernstein coefficients [n + 1]. */
void fs_triangle_of_coordinate(int32_t n, const double *f, int32_t corner, double *out);

/* Along the edge opposite corner k, with i = k + 1, j = k + 2 (mod 3) and t = l_i: row0[n + 1][width] the coefficients on
   the edge, row1[n][width] those next to it, in the order of the exponent of l_i. */
void fs_triangle_edge_rows(int32_t n, int32_t width, const double *c, int32_t k, double *row0, double *row1);

#endif
