/* SPDX-License-Identifier: MIT */
/* Single role: away from stationary points that are no minima. Levenberg-Marquardt steps stop at a saddle just as at a
   minimum when they come along its stable directions, which symmetric surfaces make them do exactly.

     H v = lambda D v, lambda least, by inverse iteration v <- (H + nu D)^-1 D v with nu > -lambda [any text on numerical
     linear algebra], D as in levenberg.c; then f(x + t v) < f(x) for some t of one sign where lambda < 0. */
#include "optimise/minimise.h"

#include <math.h>
#include <string.h>

enum { MAX_FACTORISATIONS = 30, MAX_SOLUTIONS = 40, MAX_TRIALS = 40 };
#define NEGLIGIBLE 1e-10 /* rigid motions of a closed surface have about 1e-14 */

typedef struct work {
  int32_t n;
  double *v, *Hv, *w, *normal, *diagonal, *shift, *trial, *g;
  fs_sparse hessian;
} work;

static double dot(const double *a, const double *b, size_t n) {
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

static fs_status work_create(fs_context *ctx, const fs_objective *o, work *t) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)o->n;
  t->n = o->n;
  t->hessian = *o->pattern;
  t->hessian.value = NULL;
  FS_ALLOC(ctx, t->hessian.value, 9 * (size_t)t->hessian.col_start[o->n]);
  FS_ALLOC(ctx, t->v, n);
  FS_ALLOC(ctx, t->Hv, n);
  FS_ALLOC(ctx, t->w, n);
  FS_ALLOC(ctx, t->normal, n);
  FS_ALLOC(ctx, t->trial, n);
  FS_ALLOC(ctx, t->g, n);
  FS_ALLOC(ctx, t->diagonal, o->n);
  FS_ALLOC(ctx, t->shift, o->n);
done:
  return status;
}

static void work_free(fs_context *ctx, work *t) {
  fs_release(ctx, t->v);
  fs_release(ctx, t->Hv);
  fs_release(ctx, t->w);
  fs_release(ctx, t->normal);
  fs_release(ctx, t->trial);
  fs_release(ctx, t->g);
  fs_release(ctx, t->diagonal);
  fs_release(ctx, t->shift);
  fs_release(ctx, t->hessian.value);
}

/* H + nu D is made definite; *nu from then on is the least tried that does it. */
static fs_status factor(fs_context *ctx, const fs_objective *o, work *t, double *nu, fs_saddle_report *report) {
  fs_status status = FS_OK;
  bool is_definite = false;
  for (int trial = 0; !is_definite; trial++) {
    if (trial > 0) *nu *= 4;
    for (int32_t i = 0; i < t->n; i++) t->shift[i] = *nu * t->diagonal[i];
    FS_TRY(fs_solver_factor(ctx, o->solver, &t->hessian, t->shift, &is_definite));
    report->n_factorisations++;
    if (!is_definite && trial >= MAX_FACTORISATIONS) {
      status = fs_fail(ctx, FS_ERR_NUMERIC, "the Hessian is not positive definite even with a damping of %g", *nu);
      goto done;
    }
  }
done:
  return status;
}

/* v = a vector of no symmetry, the same on every run. */
static void fill(double *v, size_t n) {
  uint32_t state = 1;
  for (size_t i = 0; i < n; i++) {
    state = state * 1664525u + 1013904223u; /* [Knuth, vol. 2, 3.3.4] */
    v[i] = state / 2147483648.0 - 1;
  }
}

/* t->v with v.D v = 1 and its quotient v.H v, about the least eigenvalue. With a normal, on vectors orthogonal to it. */
static fs_status least_curvature(fs_context *ctx, const fs_objective *o, work *t, double *lambda) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)t->n;
  double last = INFINITY, scale;
  fill(t->v, n);
  if (o->normal != NULL) FS_TRY(fs_solver_solve(ctx, o->solver, t->normal, t->w));
  for (int i = 0; i < MAX_SOLUTIONS; i++) {
    for (size_t k = 0; k < n; k++) t->Hv[k] = t->diagonal[k / 3] * t->v[k];
    FS_TRY(fs_solver_solve(ctx, o->solver, t->Hv, t->v));
    if (o->normal != NULL) {
      double mu = dot(t->normal, t->v, n) / dot(t->normal, t->w, n);
      for (size_t k = 0; k < n; k++) t->v[k] -= mu * t->w[k];
    }
    scale = 0;
    for (size_t k = 0; k < n; k++) scale += t->diagonal[k / 3] * t->v[k] * t->v[k];
    scale = 1 / sqrt(scale);
    for (size_t k = 0; k < n; k++) t->v[k] *= scale;
    fs_sparse_multiply(&t->hessian, t->v, t->Hv);
    *lambda = dot(t->v, t->Hv, n);
    if (fabs(*lambda - last) <= 0.02 * fabs(*lambda)) break;
    last = *lambda;
  }
done:
  return status;
}

static fs_status value_at(const fs_objective *o, work *t, const double *x, double length, double *f) {
  for (size_t k = 0; k < 3 * (size_t)t->n; k++) t->trial[k] = x[k] + length * t->v[k];
  return o->gradient(o->self, t->trial, f, t->g);
}

/* x moves along +-v as far as f falls, in doubled lengths from one that promises little. */
static fs_status descend(const fs_objective *o, work *t, double f, double lambda, double *x, fs_saddle_report *report) {
  fs_status status = FS_OK;
  double length = sqrt(2e-6 * fabs(f) / -lambda), best = 0, f_best = f, f_trial;
  for (int trial = 0; trial < MAX_TRIALS; trial++) {
    FS_TRY(value_at(o, t, x, length, &f_trial));
    if (isfinite(f_trial) && f_trial < f_best) {
      f_best = f_trial;
      best = length;
      length *= 2;
      continue;
    }
    if (best != 0) break;
    length = length > 0 ? -length : -length / 4;
    if (0.5 * -lambda * length * length < 1e-13 * fabs(f)) break;
  }
  for (size_t k = 0; k < 3 * (size_t)t->n; k++) x[k] += best * t->v[k];
  report->has_moved = best != 0;
  report->decrease = f - f_best;
done:
  return status;
}

fs_status fs_leave_saddle(fs_context *ctx, const fs_objective *o, double *nu, double *x, fs_saddle_report *report) {
  fs_status status = FS_OK;
  work t = {0};
  fs_saddle_report r = {0};
  double f, mean = 0;
  FS_TRY(work_create(ctx, o, &t));
  FS_TRY(o->hessian(o->self, x, &f, t.g, &t.hessian));
  FS_TRY(o->gradient(o->self, x, &f, t.g));
  if (o->normal != NULL) FS_TRY(o->normal(o->self, x, t.normal));
  fs_sparse_diagonal(&t.hessian, t.diagonal);
  for (int32_t i = 0; i < t.n; i++) mean += fabs(t.diagonal[i]) / t.n;
  for (int32_t i = 0; i < t.n; i++) t.diagonal[i] = fmax(t.diagonal[i], 1e-3 * mean);
  *nu = FS_DEFINITE_DAMPING;
  FS_TRY(factor(ctx, o, &t, nu, &r));
  if (r.n_factorisations == 1) goto done; /* definite: a minimum */
  FS_TRY(least_curvature(ctx, o, &t, &r.curvature));
  if (r.curvature < -NEGLIGIBLE) FS_TRY(descend(o, &t, f, r.curvature, x, &r));
done:
  if (status == FS_OK) *report = r;
  work_free(ctx, &t);
  return status;
}
