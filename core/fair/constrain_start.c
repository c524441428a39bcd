/* SPDX-License-Identifier: MIT */
/* Single role: from linear constraints to a setup in fewer unknowns, and to a start that meets them.

   Numbers that are solved for jump to where the constraints want them and leave the others behind. The displacement
   d(y) = x0 + T y - x_start is then made smooth: the minimum of its triharmonic energy d^T H d / 2 over y, H being constant:
     T^T H T dy = -T^T H d(y). */
#include "fair/constrain.h"
#include "math/vec3.h"

#include <string.h>

static double largest(const double *x, size_t n) {
  double value = 0;
  for (size_t i = 0; i < n; i++) value = fmax(value, fabs(x[i]));
  return value;
}

/* y[3 n_columns] += dy; displacement[3 n_free] of the free dofs at y. */
static fs_status smooth(fs_context *ctx, const fs_space *space, const fs_base *base, const fs_setup *setup,
                        const double *displacement, double *y) {
  static const fs_density *const term[1] = {&fs_density_triharmonic};
  fs_status status = FS_OK;
  const fs_reduction *map = setup->reduction;
  size_t n = (size_t)map->n_columns;
  fs_problem *p = NULL;
  fs_sparse reduced = *setup->reduced;
  fs_solver *solver = NULL;
  fs_vec3 *none = NULL; /* [n_dofs] */
  double *g = NULL, *step = NULL, *shift = NULL;
  bool is_definite = false;
  reduced.value = NULL;
  FS_ALLOC(ctx, none, space->n_dofs);
  FS_ALLOC(ctx, g, 3 * (size_t)map->n_rows);
  FS_ALLOC(ctx, step, 3 * n);
  FS_ALLOC(ctx, shift, n);
  FS_ALLOC(ctx, reduced.value, 9 * (size_t)reduced.col_start[n]);
  FS_TRY(fs_problem_create(ctx, space, 1, term, base->is_constant, 5, 10, none, &p));
  p->weight[0] = 1;
  fs_problem_set(p, displacement);
  FS_TRY(fs_problem_evaluate(p, FS_HESSIAN, NULL, NULL, g, p->pattern));
  fs_reduction_gather(map, g, step);
  FS_TRY(fs_reduction_hessian(ctx, map, p->pattern, &reduced));
  FS_TRY(fs_solver_create(ctx, setup->reduced, &solver));
  fs_sparse_diagonal(&reduced, shift);
  for (size_t i = 0; i < n; i++) shift[i] *= 1e-8; /* on closed surfaces translations cost nothing */
  FS_TRY(fs_solver_factor(ctx, solver, &reduced, shift, &is_definite));
  if (!is_definite) goto done; /* then the start is less smooth */
  FS_TRY(fs_solver_solve(ctx, solver, step, step));
  for (size_t i = 0; i < 3 * n; i++) y[i] -= step[i];
done:
  fs_solver_free(ctx, solver);
  fs_problem_free(ctx, p);
  fs_release(ctx, none);
  fs_release(ctx, g);
  fs_release(ctx, step);
  fs_release(ctx, shift);
  fs_release(ctx, reduced.value);
  return status;
}

fs_status fs_constrain_setup(fs_context *ctx, const fs_space *space, const fs_constraints *constraints,
                             const fs_base *base, fs_setup *setup, double **start) {
  fs_status status = FS_OK;
  fs_problem *p = setup->problem;
  fs_elimination *elimination = NULL;
  fs_reduction *reduction = NULL;
  double *y = NULL, *displacement = NULL;
  FS_TRY(fs_elimination_create(ctx, 3 * base->map->n_columns, &elimination));
  FS_TRY(fs_constrain_solve(ctx, space, constraints, base, elimination));
  FS_TRY(fs_constrain_reduce(ctx, space, base, elimination, p->n_free, p->unknown, &reduction, &y));
  FS_TRY(fs_setup_reduce(setup, reduction));
  FS_ALLOC(ctx, displacement, 3 * (size_t)p->n_free);
  fs_reduction_apply(reduction, y, displacement);
  for (int32_t d = 0; d < space->n_dofs; d++) {
    const double c[3] = {base->c[d].x, base->c[d].y, base->c[d].z};
    for (int k = 0; k < 3 && p->unknown[d] != FS_NONE; k++) displacement[3 * (size_t)p->unknown[d] + (size_t)k] -= c[k];
  }
  if (reduction->n_columns > 0 && largest(displacement, 3 * (size_t)p->n_free) > 1e-12 * base->size)
    FS_TRY(smooth(ctx, space, base, setup, displacement, y));
  *start = y;
  y = NULL;
done:
  fs_elimination_free(ctx, elimination);
  fs_release(ctx, y);
  fs_release(ctx, displacement);
  return status;
}
