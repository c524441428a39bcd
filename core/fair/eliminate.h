/* SPDX-License-Identifier: MIT */
/* Sparse linear equations solved for as many numbers as there are equations; the others stay free. */
#ifndef FS_FAIR_ELIMINATE_H
#define FS_FAIR_ELIMINATE_H

#include "base/base.h"

/* sum of value[k] * number column[k] = right; columns ascend */
typedef struct fs_row {
  int32_t n, *column;
  double *value, right;
} fs_row;

typedef struct fs_elimination {
  int32_t n_numbers;
  fs_row *
      *solved; /* [n_numbers] the equation solved for a number, with coefficient 1 there left out and only free numbers
                      in it: number = right - sum; NULL: a free number */
  int32_t *uses; /* [n_numbers] solved equations that contain a free number */
  double *work;  /* [n_numbers] zero between calls */
  int32_t *touched, *solved_number, n_touched, n_solved;
  bool *is_touched;
} fs_elimination;

fs_status fs_elimination_create(fs_context *ctx, int32_t n_numbers, fs_elimination **elimination);
void fs_elimination_free(fs_context *ctx, fs_elimination *elimination); /* NULL is allowed */

/* Collects an equation: adds value to the coefficient of a number. */
void fs_elimination_add(fs_elimination *elimination, int32_t number, double value);

typedef enum fs_elimination_result {
  FS_EQUATION_NEW,
  FS_EQUATION_REDUNDANT,
  FS_EQUATION_CONTRADICTS
} fs_elimination_result;

/* Ends the collected equation with its right side and solves it for the number of the largest coefficient that is left
   after the equations before. Where none above 1e-8 of the first is left it follows from them, or contradicts them by
   *residual, when that is more than 1e-10 scale. */
fs_status fs_elimination_finish(fs_context *ctx, fs_elimination *elimination, double right, double scale,
                                fs_elimination_result *result, double *residual);

#endif
