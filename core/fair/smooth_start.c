/* SPDX-License-Identifier: MIT */
/* Single role: noise is taken off a start before anything else. With T the triharmonic functional of the dofs (quadratic, order
   six), one step

     x - (T'' + nu D)^-1 T'     D = diagonal of T'', the same for x, y, z

   divides waves of length l by 1 + (l0 / l)^6 / nu, l0 some three edges: those of noise vanish, the shape stays.

   Rough: the change of H over an edge of length h, times h, has the mean square S A / n over n squares. Where it is small the
   steps of the functional itself are as good and spare a factorisation: meshes of noise of 5 % of an edge have 100, a polygon
   mesh with dents 30, smooth ones less than 1. */
#include "fair/smooth_start.h"

#include <math.h>
#include <string.h>

enum { NODES_SQUARE = 4, NODES_CAP = 6 };
static const double ROUGH = 40, NU = 1e-3, MUCH_LESS = 0.1;

/* step[3 n] = the step above at the unknowns x. */
static fs_status find_step(fs_setup *linear, const double *x, double *step) {
  fs_status status = FS_OK;
  fs_context *ctx = linear->problem->ctx;
  int32_t n = fs_setup_n(linear);
  fs_solver *solver = NULL;
  fs_sparse hessian = *fs_setup_pattern(linear);
  fs_objective o;
  double f, *g = NULL, *shift = NULL;
  bool is_definite;
  hessian.value = NULL;
  FS_ALLOC(ctx, hessian.value, 9 * (size_t)hessian.col_start[n]);
  FS_ALLOC(ctx, g, 3 * (size_t)n);
  FS_ALLOC(ctx, shift, n);
  FS_TRY(fs_solver_create(ctx, fs_setup_pattern(linear), &solver));
  o = fs_setup_objective(linear, solver);
  FS_TRY(o.hessian(o.self, x, &f, g, &hessian));
  FS_TRY(o.gradient(o.self, x, &f, g));
  fs_sparse_diagonal(&hessian, shift);
  for (int32_t i = 0; i < n; i++) shift[i] *= NU;
  FS_TRY(fs_solver_factor(ctx, solver, &hessian, shift, &is_definite));
  if (is_definite)
    FS_TRY(fs_solver_solve(ctx, solver, g, step));
  else
    memset(step, 0, 3 * (size_t)n * sizeof *step);
  for (size_t i = 0; i < 3 * (size_t)n; i++) step[i] = -step[i];
done:
  fs_solver_free(ctx, solver);
  fs_release(ctx, hessian.value);
  fs_release(ctx, g);
  fs_release(ctx, shift);
  return status;
}

fs_status fs_smooth_start(fs_setup *s, const fs_fair_options *options, double *x, fs_energy *energy) {
  fs_status status = FS_OK;
  fs_problem *p = s->problem;
  fs_context *ctx = p->ctx;
  size_t n = 3 * (size_t)fs_setup_n(s);
  fs_setup linear = {0};
  fs_quality quality;
  fs_energy after;
  double *step = NULL, *g = NULL;
  fs_setup_place(s, x);
  FS_TRY(fs_fair_quality(ctx, p->space, p->c, NODES_SQUARE, NODES_CAP, &quality));
  if (!(quality.S * quality.area > ROUGH * p->space->n_elements)) goto done;
  FS_ALLOC(ctx, step, n);
  FS_ALLOC(ctx, g, 3 * (size_t)p->n_free);
  FS_TRY(fs_setup_create(ctx, p->space, options, fs_functional_find("triharmonic"), p->c, &linear));
  fs_setup_share(&linear, s);
  FS_TRY(find_step(&linear, x, step));
  for (size_t i = 0; i < n; i++) step[i] += x[i];
  fs_setup_place(s, step);
  FS_TRY(fs_setup_measure(s, g, &after));
  if (after.F < MUCH_LESS * energy->F && isfinite(after.gradient)) {
    memcpy(x, step, n * sizeof *x);
    *energy = after;
  } else {
    fs_setup_place(s, x);
  }
done:
  fs_setup_share(&linear, NULL);
  fs_setup_free(ctx, &linear);
  fs_release(ctx, step);
  fs_release(ctx, g);
  return status;
}
