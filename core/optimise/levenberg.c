/* SPDX-License-Identifier: MIT */
/* Single role: Levenberg-Marquardt with gain ratio on the exact Hessian [Levenberg 1944; Marquardt 1963; Nielsen 1999].

     step       s = -(H + nu D)^-1 g,   D = mean of the diagonal of each 3x3 block (kept above 1e-3 of its mean over all)
     model      predicted decrease  = -g.s / 2 + nu s.D s / 2
     gain       rho = (f(x) - f(x + s)) / predicted

   nu follows rho: a factorisation costs far more than anything else, so nu falls quickly where the model is good
   (to a Newton step in the end, with its quadratic convergence) and a memory of the largest nu at which H + nu D was not
   definite, or whose step was rejected, keeps it from falling into the same hole at the next step. D makes nu free of units,
   and being the same for x, y, z, free of rotations. Differs from Nielsen's update, which needs more Hessians. */
#include "optimise/minimise.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { MAX_TRIALS = 60 }; /* factorisations for one step: nu has grown beyond any use by then */

typedef struct state {
  int32_t n;
  double *x, *trial, *g, *g_trial, *s, *diagonal, *shift;
  double *v, *w; /* the normal, and (H + nu D)^-1 times it */
  double f, nu, nu_min, nu_failed, growth;
  fs_sparse hessian; /* values of its own on the pattern of the objective */
  fs_solver *solver;
} state;

static double dot(const double *a, const double *b, size_t n) {
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

static double weighted_square(const state *t) {
  double sum = 0;
  for (int32_t i = 0; i < t->n; i++) sum += t->diagonal[i] * dot(t->s + 3 * (size_t)i, t->s + 3 * (size_t)i, 3);
  return sum;
}

static void set_diagonal(state *t) {
  double mean = 0;
  fs_sparse_diagonal(&t->hessian, t->diagonal);
  for (int32_t i = 0; i < t->n; i++) mean += fabs(t->diagonal[i]) / t->n;
  if (!(mean > 0)) mean = 1;
  for (int32_t i = 0; i < t->n; i++) t->diagonal[i] = fmax(t->diagonal[i], 1e-3 * mean);
}

/* Factors H + nu D, raising nu until it is positive definite, and solves for the step. */
static fs_status find_step(fs_context *ctx, const fs_objective *o, state *t, fs_minimise_report *report,
                           int32_t *n_factorisations) {
  fs_status status = FS_OK;
  bool is_definite = false;
  while (true) {
    for (int32_t i = 0; i < t->n; i++) t->shift[i] = t->nu * t->diagonal[i];
    FS_TRY(fs_solver_factor(ctx, t->solver, &t->hessian, t->shift, &is_definite));
    report->n_factorisations++;
    ++*n_factorisations;
    if (is_definite) break;
    if (*n_factorisations >= MAX_TRIALS) {
      status = fs_fail(ctx, FS_ERR_NUMERIC, "the Hessian is not positive definite even with a damping of %g", t->nu);
      goto done;
    }
    t->nu_failed = fmax(t->nu_failed, t->nu);
    t->nu = t->nu == 0 ? 1e-9 : t->nu * (t->nu < 1e-4 ? 10 : 4);
  }
  for (size_t i = 0; i < 3 * (size_t)t->n; i++) t->s[i] = -t->g[i];
  FS_TRY(fs_solver_solve(ctx, t->solver, t->s, t->s));
  if (o->normal != NULL) { /* s = -K^-1 g - mu K^-1 v with s.v = 0 */
    size_t n = 3 * (size_t)t->n;
    FS_TRY(fs_solver_solve(ctx, t->solver, t->v, t->w));
    double mu = dot(t->v, t->s, n) / dot(t->v, t->w, n);
    for (size_t i = 0; i < n; i++) t->s[i] -= mu * t->w[i];
  }
done:
  return status;
}

static void lower_damping(state *t, double gain) {
  if (gain > 0.9)
    t->nu *= 0.01;
  else if (gain > 0.75)
    t->nu *= 0.1;
  else if (gain < 0.25)
    t->nu *= 4;
  t->growth = 2;
  t->nu = fmax(t->nu, 3 * t->nu_failed);
  t->nu_failed = t->nu_failed < 1e-12 ? 0 : 0.1 * t->nu_failed;
  if (t->nu < t->nu_min) t->nu = t->nu_min;
  if (t->nu < 1e-15) t->nu = 0;
}

static void raise_damping(state *t) {
  t->nu_failed = fmax(t->nu_failed, t->nu);
  t->nu = fmax(t->nu, 1e-8) * fmax(t->growth, 4);
  t->growth *= 2;
}

static fs_status state_create(fs_context *ctx, const fs_objective *objective, state *t) {
  fs_status status = FS_OK;
  size_t n = (size_t)objective->n;
  t->n = objective->n;
  t->growth = 2;
  t->solver = objective->solver;
  t->hessian = *objective->pattern;
  t->hessian.value = NULL;
  FS_ALLOC(ctx, t->trial, 3 * n);
  FS_ALLOC(ctx, t->g, 3 * n);
  FS_ALLOC(ctx, t->g_trial, 3 * n);
  FS_ALLOC(ctx, t->s, 3 * n);
  FS_ALLOC(ctx, t->diagonal, n);
  FS_ALLOC(ctx, t->shift, n);
  FS_ALLOC(ctx, t->hessian.value, 9 * (size_t)t->hessian.col_start[n]);
  if (objective->normal != NULL) {
    FS_ALLOC(ctx, t->v, 3 * n);
    FS_ALLOC(ctx, t->w, 3 * n);
  }
done:
  return status;
}

static void state_free(fs_context *ctx, state *t) {
  fs_release(ctx, t->trial);
  fs_release(ctx, t->g);
  fs_release(ctx, t->g_trial);
  fs_release(ctx, t->s);
  fs_release(ctx, t->diagonal);
  fs_release(ctx, t->shift);
  fs_release(ctx, t->v);
  fs_release(ctx, t->w);
  fs_release(ctx, t->hessian.value);
}

/* Takes steps of growing damping from x until one is accepted. *is_stuck: none is, down to rounding. */
static fs_status accept_step(fs_context *ctx, const fs_objective *o, state *t, fs_minimise_report *report,
                             fs_minimise_step *step, double *predicted, bool *is_stuck) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)t->n;
  *is_stuck = false;
  step->n_factorisations = 0;
  while (true) {
    double f_trial;
    FS_TRY(find_step(ctx, o, t, report, &step->n_factorisations));
    *predicted = -0.5 * dot(t->g, t->s, n) + 0.5 * t->nu * weighted_square(t);
    for (size_t i = 0; i < n; i++) t->trial[i] = t->x[i] + t->s[i];
    FS_TRY(o->value(o->self, t->trial, &f_trial));
    step->gain = (t->f - f_trial) / *predicted;
    if (isfinite(f_trial) && f_trial < t->f && step->gain > 1e-4) {
      step->value = f_trial;
      step->damping = t->nu;
      step->length = sqrt(dot(t->s, t->s, n));
      break;
    }
    if (*predicted <= 1e-13 * fabs(t->f) || step->n_factorisations >= MAX_TRIALS) {
      *is_stuck = true;
      break;
    }
    raise_damping(t);
  }
done:
  return status;
}

fs_status fs_minimise(fs_context *ctx, const fs_objective *o, const fs_minimise_options *options, double *x,
                      fs_minimise_report *report) {
  fs_status status = FS_OK;
  state t = {
      .x = x, .nu = options->damping->nu, .nu_min = options->least_damping, .nu_failed = options->damping->nu_failed};
  fs_minimise_report r = {.stop = FS_MINIMISE_ITERATIONS};
  size_t n = 3 * (size_t)o->n;
  double gradient_start = options->gradient_start;
  FS_TRY(state_create(ctx, o, &t));
  while (true) {
    fs_minimise_step step = {.number = r.n_steps + 1};
    double predicted;
    bool is_stuck;
    FS_TRY(o->hessian(o->self, x, &t.f, t.g, &t.hessian));
    r.n_hessians++;
    r.value = t.f;
    r.gradient = sqrt(dot(t.g, t.g, n));
    if (r.n_steps == 0) {
      if (gradient_start == 0) gradient_start = r.gradient;
      if (!isfinite(t.f) || !isfinite(r.gradient)) {
        status = fs_fail(ctx, FS_ERR_NUMERIC, "the functional is not finite at the start");
        goto done;
      }
      step = (fs_minimise_step){.value = t.f, .gradient = r.gradient};
      if (options->monitor != NULL && !options->monitor(options->user, &step)) {
        r.stop = FS_MINIMISE_CANCELLED;
        break;
      }
      step.number = 1;
    }
    if (r.gradient <= DBL_MIN) {
      r.stop = FS_MINIMISE_GRADIENT;
      break;
    }
    if (r.n_steps >= options->max_iterations) break;
    set_diagonal(&t);
    if (o->normal != NULL) FS_TRY(o->normal(o->self, x, t.v));
    FS_TRY(accept_step(ctx, o, &t, &r, &step, &predicted, &is_stuck));
    if (is_stuck) {
      r.stop = r.gradient <= options->gradient_tolerance * gradient_start ? FS_MINIMISE_GRADIENT : FS_MINIMISE_DECREASE;
      break;
    }
    memcpy(x, t.trial, n * sizeof *x);
    r.n_steps++;
    lower_damping(&t, step.gain);
    /* the gradient at the new point decides whether another Hessian is worth its price */
    FS_TRY(o->gradient(o->self, x, &r.value, t.g_trial));
    r.gradient = step.gradient = sqrt(dot(t.g_trial, t.g_trial, n));
    if (options->monitor != NULL && !options->monitor(options->user, &step)) {
      r.stop = FS_MINIMISE_CANCELLED;
      break;
    }
    if (options->gradient_tolerance == 0 && predicted <= options->decrease_tolerance * fabs(t.f) && step.gain > 0.5 &&
        step.gain < 2) {
      r.stop = FS_MINIMISE_DECREASE;
      break;
    }
    bool is_flat = r.gradient <= options->gradient_tolerance * gradient_start;
    if (is_flat) { /* the decrease that is left, by the factor that is there: is another Hessian worth its price? */
      FS_TRY(fs_solver_solve(ctx, t.solver, t.g_trial, t.s));
      if (0.5 * dot(t.g_trial, t.s, n) <= options->decrease_tolerance * fabs(r.value)) {
        r.stop = FS_MINIMISE_GRADIENT;
        break;
      }
    }
    if (predicted <= 1e-13 * fabs(t.f) && t.f - r.value < 1e-11 * fabs(t.f)) {
      r.stop = FS_MINIMISE_DECREASE; /* rounding */
      break;
    }
    if (step.length <= 4 * DBL_EPSILON * sqrt(dot(x, x, n))) {
      r.stop = FS_MINIMISE_STEP;
      break;
    }
  }
done:
  if (status == FS_ERR_CANCELLED) { /* in the middle of an evaluation: x still is the best point met */
    r.stop = FS_MINIMISE_CANCELLED;
    status = FS_OK;
  }
  if (status == FS_OK) *report = r;
  *options->damping = (fs_damping){t.nu, t.nu_failed};
  state_free(ctx, &t);
  return status;
}
