/* SPDX-License-Identifier: MIT */
/* Dense linear algebra on row-major arrays, for matrices of up to some hundreds of rows. A matrix [rows][columns] with
   row stride s has the element (i, j) at i s + j. Every inner loop runs along rows, so that it vectorises. */
#ifndef FS_MATH_DENSE_H
#define FS_MATH_DENSE_H

#include "base/base.h"

/* Upper triangle of C [n][n] += sign A^T A, with A [rows][n] and sign = 1 or -1. What lies below the diagonal of C is
   untouched except within blocks of 4 rows. */
void fs_dense_add_gram(int32_t rows, int32_t n, const double *A, int32_t a_stride, double sign, double *C,
                       int32_t c_stride);

/* Copies the upper triangle of C [n][n] to the lower one. */
void fs_dense_mirror(int32_t n, double *C, int32_t stride);

/* C [rows][columns] += factor A B with A [rows][inner], B [inner][columns]. */
void fs_dense_add_product(int32_t rows, int32_t inner, int32_t columns, double factor, const double *A,
                          int32_t a_stride, const double *B, int32_t b_stride, double *C, int32_t c_stride);

/* The same with A transposed, A [inner][rows]. */
void fs_dense_add_product_transposed(int32_t rows, int32_t inner, int32_t columns, double factor, const double *A,
                                     int32_t a_stride, const double *B, int32_t b_stride, double *C, int32_t c_stride);

/* Cholesky: the upper triangle of A [n][n] becomes R with A = R^T R; what lies below the diagonal is not read and left
   meaningless. FS_ERR_NUMERIC names the row where A is found not to be positive definite. */
fs_status fs_dense_cholesky(fs_context *ctx, int32_t n, double *A, int32_t stride);

/* B [n][width] = R^-T B, and B = R^-1 B. */
void fs_dense_solve_transposed(int32_t n, const double *R, int32_t stride, int32_t width, double *B, int32_t b_stride);
void fs_dense_solve_upper(int32_t n, const double *R, int32_t stride, int32_t width, double *B, int32_t b_stride);

/* Orthonormal basis of the null space of A [rows][columns], dense (stride = columns), whose rank the caller knows:
   basis [columns - rank][columns], A basis_i = 0. FS_ERR_NUMERIC where the rank is evidently another. */
fs_status fs_dense_null_space(fs_context *ctx, int32_t rows, int32_t columns, const double *A, int32_t rank,
                              double *basis);

#endif
