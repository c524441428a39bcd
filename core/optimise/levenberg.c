/* SPDX-License-Identifier: MIT */
/* Single role: Levenberg-Marquardt with gain ratio on the exact Hessian [Levenberg 1944; Marquardt 1963; Nielsen 1999], with
   quasi-Newton steps in between.

     step       s = -(H + nu D)^-1 g,   D = mean of the diagonal of each 3x3 block (kept above 1e-3 of its mean over all)
     model      predicted decrease  = -g.s / 2 + nu s.D s / 2
     gain       rho = (f(x) - f(x + s)) / predicted

   nu follows rho (damping.c). D makes nu free of units, and being the same for x, y, z, free of rotations. An objective may bring
   a D of its own, a semidefinite matrix that weighs motions as the objective does: its metric.

   For the same reason every factorisation is used again for as long as it pays: steps s = -B g, where B is its inverse
   corrected by the pairs of steps and gradient changes since (memory.c). One costs a gradient and a solution. A caller who wants
   the quadratic convergence of Newton's method at the end asks for a Hessian per step. */
#include "optimise/minimise.h"
#include "optimise/damping.h"
#include "optimise/memory.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { MAX_SHORTENED = 3, MAX_LENGTH = 100 };
enum { MAX_TRIALS = 60 }; /* factorisations for one step: nu has grown beyond any use by then */
/* Of a quasi-Newton step: its predicted decrease by that of the step before; with a factorisation from before the start, which
   belongs to another function and was not damped in a metric, and with any other one. */
static const double worth_going_on_old = 0.1, worth_going_on = 0.5;

/* Predicted decreases relative to f below which the rest of the way is short. */
static const double short_way = 1e-3;

/* A metric may be blind to some motions. Where nu had to grow large the diagonal helps, shifted by this times nu^2. */
static const double of_diagonal = 1e-10;

typedef struct state {
  int32_t n;
  double *x, *trial, *g, *g_trial, *s, *diagonal, *shift;
  double *product; /* with a metric: of it and a step */
  double *v, *w;   /* the normal, and (H + nu D)^-1 times it */
  double f, f_trial, f_begin;
  fs_nu nu;
  double nu_factored;      /* in the factorisation that is there */
  fs_sparse hessian;       /* values of its own on the pattern of the objective */
  const fs_sparse *metric; /* of the objective; NULL: the diagonal */
  fs_solver *solver;
  fs_memory memory;           /* of steps since the last factorisation */
  bool is_factored;           /* the solver holds a factorisation made near x */
  double predicted, decrease; /* by the last accepted step */
  fs_minimise_step step;      /* the last accepted one */
} state;

static double dot(const double *a, const double *b, size_t n) {
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

static double norm(const double *a, size_t n) { return sqrt(dot(a, a, n)); }

/* nu s.D s with the damping of the last factorisation. */
static double damped_square(const state *t) {
  double sum = 0;
  for (int32_t i = 0; i < t->n; i++) sum += t->shift[i] * dot(t->s + 3 * (size_t)i, t->s + 3 * (size_t)i, 3);
  if (t->metric == NULL || t->nu_factored == 0) return sum;
  fs_sparse_multiply(t->metric, t->s, t->product);
  return sum + t->nu_factored * dot(t->s, t->product, 3 * (size_t)t->n);
}

static void set_diagonal(state *t) {
  double mean = 0;
  fs_sparse_diagonal(&t->hessian, t->diagonal);
  for (int32_t i = 0; i < t->n; i++) mean += fabs(t->diagonal[i]) / t->n;
  if (!(mean > 0)) mean = 1;
  for (int32_t i = 0; i < t->n; i++) t->diagonal[i] = fmax(t->diagonal[i], 1e-3 * mean);
}

/* d = K^-1 b, K the factored matrix; with a normal v: K^-1 b - mu K^-1 v such that d.v = 0. */
static fs_status solve(fs_context *ctx, const fs_objective *o, state *t, const double *b, double *d) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)t->n;
  FS_TRY(fs_solver_solve(ctx, t->solver, b, d));
  if (o->normal != NULL) {
    double mu;
    FS_TRY(fs_solver_solve(ctx, t->solver, t->v, t->w));
    mu = dot(t->v, d, n) / dot(t->v, t->w, n);
    for (size_t i = 0; i < n; i++) d[i] -= mu * t->w[i];
  }
done:
  return status;
}

/* Factors H + nu D, raising nu until it is positive definite, and solves for the step. */
static fs_status find_step(fs_context *ctx, const fs_objective *o, state *t, fs_minimise_report *report,
                           int32_t *n_factorisations) {
  fs_status status = FS_OK;
  while (true) {
    double nu = t->metric != NULL ? t->nu.least + of_diagonal * t->nu.now * t->nu.now : t->nu.now;
    t->nu_factored = t->nu.now;
    for (int32_t i = 0; i < t->n; i++) t->shift[i] = nu * t->diagonal[i];
    FS_TRY(fs_solver_factor_sum(ctx, t->solver, &t->hessian, t->nu.now, t->metric, t->shift, &t->is_factored));
    report->n_factorisations++;
    ++*n_factorisations;
    if (t->is_factored) break;
    if (*n_factorisations >= MAX_TRIALS) {
      status =
          fs_fail(ctx, FS_ERR_NUMERIC, "the Hessian is not positive definite even with a damping of %g", t->nu.now);
      goto done;
    }
    fs_nu_raise_indefinite(&t->nu);
  }
  fs_memory_clear(&t->memory);
  FS_TRY(solve(ctx, o, t, t->g, t->s));
  for (size_t i = 0; i < 3 * (size_t)t->n; i++) t->s[i] = -t->s[i];
done:
  return status;
}

static fs_status state_create(fs_context *ctx, const fs_objective *objective, state *t) {
  fs_status status = FS_OK;
  size_t n = (size_t)objective->n;
  t->n = objective->n;
  t->solver = objective->solver;
  t->memory.n = 3 * n;
  t->hessian = *objective->pattern;
  t->hessian.value = NULL;
  FS_ALLOC(ctx, t->trial, 3 * n);
  FS_ALLOC(ctx, t->g, 3 * n);
  FS_ALLOC(ctx, t->g_trial, 3 * n);
  FS_ALLOC(ctx, t->s, 3 * n);
  FS_ALLOC(ctx, t->diagonal, n);
  FS_ALLOC(ctx, t->shift, n);
  FS_ALLOC(ctx, t->hessian.value, 9 * (size_t)t->hessian.col_start[n]);
  if (objective->metric != NULL) FS_ALLOC(ctx, t->product, 3 * n);
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
  fs_release(ctx, t->product);
  fs_release(ctx, t->v);
  fs_release(ctx, t->w);
  fs_release(ctx, t->hessian.value);
  fs_memory_release(ctx, &t->memory);
}

/* Below this, relative to f, decreases drown in rounding and the gradient alone tells whether a step is good. */
static const double rounding = 1e-13;

/* f and the gradient at x + s; *gain = what the step brings by what was predicted. */
static fs_status try_step(const fs_objective *o, state *t, double predicted, double *gain) {
  fs_status status = FS_OK;
  for (size_t i = 0; i < 3 * (size_t)t->n; i++) t->trial[i] = t->x[i] + t->s[i];
  FS_TRY(o->gradient(o->self, t->trial, &t->f_trial, t->g_trial));
  *gain = isfinite(t->f_trial) && t->f_trial < t->f ? (t->f - t->f_trial) / predicted : -1;
  if (predicted <= rounding * fabs(t->f) && fabs(t->f_trial - t->f) <= rounding * fabs(t->f) &&
      norm(t->g_trial, 3 * (size_t)t->n) <= 0.7 * norm(t->g, 3 * (size_t)t->n))
    *gain = 1;
done:
  return status;
}

/* The trial becomes x. */
static fs_status accept(fs_context *ctx, state *t, fs_minimise_report *report, double gain, int32_t n_factorisations,
                        double predicted) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)t->n;
  double *g = t->g;
  FS_TRY(fs_memory_add(ctx, &t->memory, t->s, t->g, t->g_trial));
  t->g = t->g_trial;
  t->g_trial = g;
  memcpy(t->x, t->trial, n * sizeof *t->x);
  report->value = t->f_trial;
  report->gradient = norm(t->g, n);
  t->step = (fs_minimise_step){.number = ++report->n_steps,
                               .n_factorisations = n_factorisations,
                               .value = t->f_trial,
                               .gradient = report->gradient,
                               .damping = t->nu_factored,
                               .length = norm(t->s, n),
                               .gain = gain};
  t->decrease = t->f - t->f_trial;
  t->f = t->f_trial;
  t->predicted = predicted;
done:
  return status;
}

/* Shorter steps in the direction of a rejected one: a gradient each, where another damping would cost a factorisation.
   The model along the direction d with K d = -g, K = H + nu D:  -a t + (a - nu d.D d) t^2 / 2,  a = -g.d > 0. */
static fs_status shorten_step(const fs_objective *o, state *t, double *predicted, double *gain, double *length) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)t->n;
  double a = -dot(t->g, t->s, n), curvature = a - damped_square(t), shorter = 1;
  for (int i = 0; i < MAX_SHORTENED && !(*gain > 0.1) && *predicted > rounding * fabs(t->f); i++) {
    for (size_t k = 0; k < n; k++) t->s[k] *= 0.3;
    shorter *= 0.3;
    *predicted = a * shorter - 0.5 * curvature * shorter * shorter;
    FS_TRY(try_step(o, t, *predicted, gain));
  }
  *length = shorter;
done:
  return status;
}

/* Longer steps in the direction of a good one that damping kept short, at a gradient each: along it the model falls up to
   t = a / (a - nu d.D d), or for ever. Near saddles this is the way down, and saves many a factorisation. */
static fs_status lengthen_step(const fs_objective *o, state *t, double *predicted, double *gain) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)t->n;
  double a = -dot(t->g, t->s, n), curvature = a - damped_square(t), length = 1;
  double best = curvature > 0 ? a / curvature : INFINITY;
  while (length < MAX_LENGTH && best > 2 * length && *gain > 0.75) {
    double factor = fmin(best / length, 3), f = t->f_trial, old_predicted = *predicted, old_gain = *gain;
    length *= factor;
    for (size_t k = 0; k < n; k++) t->s[k] *= factor;
    *predicted = a * length - 0.5 * curvature * length * length;
    FS_TRY(try_step(o, t, *predicted, gain));
    if (t->f_trial<f && * gain> 0.5) continue;
    for (size_t k = 0; k < n; k++) t->s[k] /= factor; /* too long: back to the one before */
    *predicted = old_predicted;
    FS_TRY(try_step(o, t, *predicted, gain));
    *gain = old_gain;
    break;
  }
done:
  return status;
}

/* Takes steps of growing damping from x until one is accepted. *is_stuck: none is, down to rounding. */
static fs_status newton_step(fs_context *ctx, const fs_objective *o, state *t, fs_minimise_report *report,
                             bool *is_taken, bool *is_stuck) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)t->n;
  int32_t n_factorisations = 0;
  double gain, predicted, shortened, f_unused;
  *is_taken = *is_stuck = false;
  FS_TRY(o->hessian(o->self, t->x, &f_unused, t->s, &t->hessian));
  report->n_hessians++;
  set_diagonal(t);
  if (o->metric != NULL) FS_TRY(o->metric(o->self, t->x, &t->metric));
  if (o->normal != NULL) FS_TRY(o->normal(o->self, t->x, t->v));
  while (true) {
    FS_TRY(find_step(ctx, o, t, report, &n_factorisations));
    predicted = -0.5 * dot(t->g, t->s, n) + 0.5 * damped_square(t);
    FS_TRY(try_step(o, t, predicted, &gain));
    shortened = 1;
    if (!(gain > 1e-4)) FS_TRY(shorten_step(o, t, &predicted, &gain, &shortened));
    if (gain > 1e-4) break;
    if (predicted <= rounding * fabs(t->f) || n_factorisations >= MAX_TRIALS) {
      *is_stuck = true;
      goto done;
    }
    fs_nu_raise_rejected(&t->nu);
  }
  if (shortened == 1) FS_TRY(lengthen_step(o, t, &predicted, &gain));
  fs_nu_lower(&t->nu, shortened < 1 ? 0 : gain, n_factorisations > 1, predicted <= short_way * fabs(t->f));
  FS_TRY(accept(ctx, t, report, gain, n_factorisations, predicted));
  *is_taken = true;
done:
  return status;
}

/* One step with the factorisation that is there. *is_taken: it was accepted. *is_stuck: there is nothing left to gain. */
static fs_status quasi_newton_step(fs_context *ctx, const fs_objective *o, state *t, fs_minimise_report *report,
                                   bool *is_taken, bool *is_stuck) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)t->n;
  double alpha[FS_MEMORY_PAIRS], gain, predicted;
  double worth = report->n_hessians == 0 && o->metric == NULL ? worth_going_on_old : worth_going_on;
  *is_taken = *is_stuck = false;
  memcpy(t->s, t->g, n * sizeof *t->s);
  fs_memory_before(&t->memory, t->s, alpha);
  FS_TRY(solve(ctx, o, t, t->s, t->s));
  fs_memory_after(&t->memory, t->s, alpha);
  for (size_t i = 0; i < n; i++) t->s[i] = -t->s[i];
  predicted = -0.5 * dot(t->g, t->s, n);
  if (!(predicted > 0 && (predicted <= worth * t->predicted || predicted <= rounding * fabs(t->f)))) goto done;
  FS_TRY(try_step(o, t, predicted, &gain));
  *is_stuck = gain <= 0.1 && predicted <= rounding * fabs(t->f);
  if (!(gain > 0.1)) goto done;
  FS_TRY(accept(ctx, t, report, gain, 0, predicted));
  *is_taken = true;
done:
  return status;
}

/* Whether the last accepted step was the last one needed. */
static fs_status is_done(fs_context *ctx, const fs_objective *o, const fs_minimise_options *options, state *t,
                         double gradient_start, fs_minimise_report *r, bool *done) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)t->n;
  *done = true;
  if (options->monitor != NULL && !options->monitor(options->user, &t->step)) {
    r->stop = FS_MINIMISE_CANCELLED;
    return FS_OK;
  }
  if (options->gradient_tolerance == 0 && t->predicted <= options->decrease_tolerance * fabs(t->f) &&
      t->step.gain > 0.5 && t->step.gain < 2) {
    r->stop = FS_MINIMISE_DECREASE;
    return FS_OK;
  }
  if (r->gradient <= options->gradient_tolerance * gradient_start) { /* how much decrease is left? */
    FS_TRY(solve(ctx, o, t, t->g, t->s));
    /* where the minimum is 0 nothing is small beside it, but rounding of the start may be left */
    if (0.5 * dot(t->g, t->s, n) <= options->decrease_tolerance * fmax(fabs(t->f), rounding * fabs(t->f_begin))) {
      r->stop = FS_MINIMISE_GRADIENT;
      return FS_OK;
    }
  }
  if (t->step.length <= 4 * DBL_EPSILON * norm(t->x, n)) {
    r->stop = FS_MINIMISE_STEP;
    return FS_OK;
  }
  *done = false;
done:
  return status;
}

/* f and g at the start. */
static fs_status begin(fs_context *ctx, const fs_objective *o, const fs_minimise_options *options, state *t,
                       fs_minimise_report *r) {
  fs_status status = FS_OK;
  FS_TRY(o->gradient(o->self, t->x, &t->f, t->g));
  r->value = t->f_begin = t->f;
  r->gradient = norm(t->g, 3 * (size_t)t->n);
  if (!isfinite(t->f) || !isfinite(r->gradient)) {
    status = fs_fail(ctx, FS_ERR_NUMERIC, "the functional is not finite at the start");
    goto done;
  }
  t->step = (fs_minimise_step){.value = t->f, .gradient = r->gradient};
  if (options->monitor != NULL && !options->monitor(options->user, &t->step)) r->stop = FS_MINIMISE_CANCELLED;
  if (o->normal != NULL && t->is_factored) FS_TRY(o->normal(o->self, t->x, t->v));
  t->predicted = INFINITY; /* whatever a step with a factorisation from before promises, it is tried */
done:
  return status;
}

fs_status fs_minimise(fs_context *ctx, const fs_objective *o, const fs_minimise_options *options, double *x,
                      fs_minimise_report *report) {
  fs_status status = FS_OK;
  state t = {.x = x,
             .nu = {.now = options->damping->nu,
                    .least = options->least_damping,
                    .growth = 2,
                    .failed = options->damping->nu_failed,
                    .of_metric = o->metric != NULL},
             .nu_factored = options->damping->nu_factored,
             .is_factored = options->damping->is_factored};
  fs_minimise_report r = {.stop = FS_MINIMISE_ITERATIONS};
  double gradient_start = options->gradient_start;
  FS_TRY(state_create(ctx, o, &t));
  FS_TRY(begin(ctx, o, options, &t, &r));
  if (gradient_start == 0) gradient_start = r.gradient;
  while (r.stop != FS_MINIMISE_CANCELLED && r.n_steps < options->max_iterations) {
    bool is_over = false, is_taken = false, is_stuck = false;
    if (r.gradient <= DBL_MIN) {
      r.stop = FS_MINIMISE_GRADIENT;
      break;
    }
    if (t.is_factored && !options->is_newton)
      FS_TRY(quasi_newton_step(ctx, o, &t, &r, &is_taken, &is_stuck));
    else
      FS_TRY(newton_step(ctx, o, &t, &r, &is_taken, &is_stuck));
    t.is_factored = is_taken;
    if (is_stuck) {
      r.stop = r.gradient <= options->gradient_tolerance * gradient_start ? FS_MINIMISE_GRADIENT : FS_MINIMISE_DECREASE;
      break;
    }
    if (is_taken) FS_TRY(is_done(ctx, o, options, &t, gradient_start, &r, &is_over));
    if (is_over) break;
  }
done:
  if (status == FS_ERR_CANCELLED) { /* in the middle of an evaluation: x still is the best point met */
    r.stop = FS_MINIMISE_CANCELLED;
    status = FS_OK;
  }
  if (status == FS_OK) *report = r;
  *options->damping = (fs_damping){t.nu.now, t.nu.failed, t.nu_factored, t.is_factored};
  state_free(ctx, &t);
  return status;
}
