/* SPDX-License-Identifier: MIT */
/* What any solver of symmetric positive definite systems offers: analyse once per pattern, factor, solve. */
#ifndef FS_SOLVE_SOLVER_H
#define FS_SOLVE_SOLVER_H

#include "solve/sparse.h"

typedef struct fs_solver fs_solver;

/* Chooses an elimination order for the pattern (of its graph of blocks: AMD or METIS, whichever gives less fill) and plans
   the factorisation. The pattern is borrowed and must outlive the solver. */
fs_status fs_solver_create(fs_context *ctx, const fs_sparse *pattern, fs_solver **solver);
void fs_solver_free(fs_context *ctx, fs_solver *solver); /* NULL is allowed */

/* Factors A + diag(shift), shift[n_blocks] standing for three equal entries each, A having the pattern of the solver.
   Not positive definite: FS_OK and *is_definite = false; then there is nothing to solve with. */
fs_status fs_solver_factor(fs_context *ctx, fs_solver *solver, const fs_sparse *a, const double *shift,
                           bool *is_definite);

/* The same for A + nu B + diag(shift), B on the same pattern; NULL: 0. */
fs_status fs_solver_factor_sum(fs_context *ctx, fs_solver *solver, const fs_sparse *a, double nu, const fs_sparse *b,
                               const double *shift, bool *is_definite);

/* What was done so far, and what one factorisation takes. */
typedef struct fs_solver_costs {
  int32_t n_factorisations;
  double analysis, factorisations; /* processor seconds, of all threads together */
  double flops, bytes;             /* of one factorisation, and of its factor */
} fs_solver_costs;
fs_solver_costs fs_solver_get_costs(const fs_solver *solver);

/* x = (A + diag(shift))^-1 b, both [3 n_blocks]; may be the same array. */
fs_status fs_solver_solve(fs_context *ctx, fs_solver *solver, const double *b, double *x);

#endif
