/* SPDX-License-Identifier: MIT */
/* Single role: space, functional and fixed dofs become a minimisation, and its course a report. */
#include "fair/problem.h"
#include "optimise/minimise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- scale ------------------------------------------------------------------------------------------------------- */

typedef struct radial {
  double radius;
  fs_vec3 position;
} radial;

static int compare_radius(const void *a, const void *b) {
  double x = ((const radial *)a)->radius, y = ((const radial *)b)->radius;
  return (x < y) - (x > y);
}

static double distance(fs_vec3 a, fs_vec3 b) { return hypot(hypot(a.x - b.x, a.y - b.y), a.z - b.z); }

/* Largest distance of two fixed vertices: pairs are tried outwards in, and no pair within radii r_i + r_j <= best remains. */
static fs_status fixed_diameter(fs_context *ctx, const fs_space *space, const bool *fixed, double *diameter) {
  fs_status status = FS_OK;
  radial *point = NULL;
  fs_vec3 centre = {0};
  int32_t n = 0;
  double best = 0;
  *diameter = 0;
  if (fixed == NULL) return FS_OK;
  FS_ALLOC(ctx, point, space->n_vertices);
  for (int32_t v = 0; v < space->n_vertices; v++)
    if (fixed[v]) point[n++].position = space->start[v];
  for (int32_t i = 0; i < n; i++) {
    centre.x += point[i].position.x / n;
    centre.y += point[i].position.y / n;
    centre.z += point[i].position.z / n;
  }
  for (int32_t i = 0; i < n; i++) point[i].radius = distance(point[i].position, centre);
  qsort(point, (size_t)n, sizeof *point, compare_radius);
  for (int32_t i = 0; i < n && 2 * point[i].radius > best; i++)
    for (int32_t j = i + 1; j < n && point[i].radius + point[j].radius > best; j++)
      best = fmax(best, distance(point[i].position, point[j].position));
  *diameter = best;
done:
  fs_release(ctx, point);
  return status;
}

/* ---- from options to a problem ----------------------------------------------------------------------------------- */

enum { NODES_SQUARE = 8, NODES_CAP = 12, MAX_NODES = 32, MAX_PARAMS = 16 };

typedef struct setup {
  const fs_functional *functional;
  fs_problem *problem;
  double c;                            /* weight of Q */
  int32_t term_S, term_Q;              /* terms of the problem: those of the functional and what is only measured */
} setup;

static int32_t find_or_add_term(const fs_density **term, int32_t *n, const fs_density *density) {
  for (int32_t t = 0; t < *n; t++)
    if (term[t] == density) return t;
  term[*n] = density;
  return (*n)++;
}

static fs_status set_weights(fs_context *ctx, const fs_space *space, const fs_fair_options *options, setup *s) {
  fs_status status = FS_OK;
  double param[MAX_PARAMS] = {0};
  fs_scale scale = {.n_squares = space->n_elements};
  const fs_param *params = s->functional->params;
  FS_TRY(fixed_diameter(ctx, space, options->fixed, &scale.diameter));
  for (int i = 0; params != NULL && params[i].name != NULL && i < MAX_PARAMS; i++) {
    param[i] = options->param != NULL ? options->param[i] : params[i].initial;
    if (!(param[i] >= params[i].min && param[i] <= params[i].max))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "parameter %s of %s is %g: %g to %g are possible", params[i].name,
                     s->functional->name, param[i], params[i].min, params[i].max);
  }
  s->functional->weights(param, &scale, s->problem->weight);
  s->c = 0;
  for (int32_t t = 0; t < s->functional->n_terms; t++)
    if (s->functional->term[t] == &fs_density_tangential) s->c = s->problem->weight[t];
done:
  return status;
}

static fs_status setup_create(fs_context *ctx, const fs_space *space, const fs_fair_options *options,
                              const fs_functional *functional, const fs_vec3 *c, setup *s) {
  fs_status status = FS_OK;
  const fs_density *term[FS_MAX_TERMS + 2];
  int32_t n = functional->n_terms, square = options->n_nodes_square, cap = options->n_nodes_cap;
  *s = (setup){.functional = functional};
  if (square == 0) square = NODES_SQUARE;
  if (cap == 0) cap = NODES_CAP;
  if (square < 1 || square > MAX_NODES || cap < 1 || cap > MAX_NODES)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%d nodes on squares and %d in caps: 1 to %d are possible", square, cap, MAX_NODES);
  if (n < 1 || n > FS_MAX_TERMS - 2)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the functional %s has %d terms: 1 to %d are possible", functional->name, n,
                   FS_MAX_TERMS - 2);
  for (int32_t t = 0; t < n; t++) term[t] = functional->term[t];
  s->term_S = find_or_add_term(term, &n, &fs_density_curvature_variation);
  s->term_Q = find_or_add_term(term, &n, &fs_density_tangential);
  FS_TRY(fs_problem_create(ctx, space, n, term, options->fixed, square, cap, c, &s->problem));
  FS_TRY(set_weights(ctx, space, options, s));
done:
  if (status != FS_OK) {
    fs_problem_free(ctx, s->problem);
    s->problem = NULL;
  }
  return status;
}

/* Energies at problem->c; g[3 n_free] is work space. */
static fs_status measure(setup *s, double *g, fs_energy *energy) {
  fs_status status = FS_OK;
  fs_problem *p = s->problem;
  fs_energy e = {0};
  double all[FS_MAX_TERMS], caps[FS_MAX_TERMS];
  FS_TRY(fs_problem_evaluate(p, FS_GRADIENT, all, caps, g, NULL));
  for (int32_t t = 0; t < s->functional->n_terms; t++) {
    e.integral[t] = all[t];
    e.integral_caps[t] = caps[t];
    e.weight[t] = p->weight[t];
    e.F += p->weight[t] * all[t];
  }
  e.S = all[s->term_S];
  e.S_caps = caps[s->term_S];
  e.Q = all[s->term_Q];
  for (size_t i = 0; i < 3 * (size_t)p->n_free; i++) e.gradient += g[i] * g[i];
  e.gradient = sqrt(e.gradient);
  *energy = e;
done:
  return status;
}

/* ---- the objective ----------------------------------------------------------------------------------------------- */

static fs_status evaluate(setup *s, fs_order order, const double *x, double *f, double *g, fs_sparse *hessian) {
  fs_status status = FS_OK;
  double integral[FS_MAX_TERMS];
  fs_problem_set(s->problem, x);
  FS_TRY(fs_progress(s->problem->ctx, "fairing", 0));
  FS_TRY(fs_problem_evaluate(s->problem, order, integral, NULL, g, hessian));
  *f = 0;
  for (int32_t t = 0; t < s->functional->n_terms; t++) *f += s->problem->weight[t] * integral[t];
done:
  return status;
}

static fs_status value(void *self, const double *x, double *f) { return evaluate(self, FS_VALUE, x, f, NULL, NULL); }
static fs_status gradient(void *self, const double *x, double *f, double *g) {
  return evaluate(self, FS_GRADIENT, x, f, g, NULL);
}
static fs_status hessian(void *self, const double *x, double *f, double *g, fs_sparse *h) {
  return evaluate(self, FS_HESSIAN, x, f, g, h);
}

/* ---- fairing ----------------------------------------------------------------------------------------------------- */

typedef struct course {
  const fs_fair_options *options;
  fs_fair_report *report;
  struct timespec start;
} course;

static bool record(void *user, const fs_minimise_step *m) {
  course *c = user;
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  fs_step step = {.number = m->number,
                  .value = m->value,
                  .gradient = m->gradient,
                  .damping = m->damping,
                  .length = m->length,
                  .gain = m->gain,
                  .n_factorisations = m->n_factorisations,
                  .seconds = (double)(now.tv_sec - c->start.tv_sec) + 1e-9 * (double)(now.tv_nsec - c->start.tv_nsec)};
  if (c->report->n_trace < FS_MAX_TRACE) c->report->trace[c->report->n_trace++] = step;
  return c->options->monitor == NULL || c->options->monitor(c->options->monitor_user, &step);
}

static bool is_quadratic(const fs_functional *functional) {
  for (int32_t t = 0; t < functional->n_terms; t++)
    if (!functional->term[t]->is_quadratic) return false;
  return true;
}

static fs_status minimise(fs_context *ctx, setup *s, const fs_fair_options *options, course *course, double *x,
                          fs_minimise_report *m) {
  fs_objective objective = {.n = s->problem->n_free,
                            .pattern = s->problem->pattern,
                            .self = s,
                            .value = value,
                            .gradient = gradient,
                            .hessian = hessian};
  fs_minimise_options o = {.max_iterations = options->max_iterations == 0 ? 100 : options->max_iterations,
                           .gradient_tolerance = options->gradient_tolerance == 0 ? 1e-8 : options->gradient_tolerance,
                           .decrease_tolerance = 1e-12,
                           .damping = is_quadratic(s->functional) ? 0 : 1,
                           .monitor = course != NULL ? record : NULL,
                           .user = course};
  return fs_minimise(ctx, &objective, &o, x, m);
}

/* c = the minimum of the triharmonic functional with the same dofs fixed. */
static fs_status start_triharmonic(fs_context *ctx, const fs_space *space, const fs_fair_options *options, fs_vec3 *c) {
  fs_status status = FS_OK;
  setup s = {0};
  double *x = NULL;
  fs_minimise_report m;
  fs_fair_options o = {.fixed = options->fixed,
                       .n_nodes_square = options->n_nodes_square,
                       .n_nodes_cap = options->n_nodes_cap,
                       .max_iterations = 4};
  FS_TRY(setup_create(ctx, space, &o, fs_functional_find("triharmonic"), c, &s));
  FS_ALLOC(ctx, x, 3 * (size_t)s.problem->n_free);
  fs_problem_get(s.problem, x);
  FS_TRY(minimise(ctx, &s, &o, NULL, x, &m));
  fs_problem_set(s.problem, x);
  memcpy(c, s.problem->c, (size_t)space->n_dofs * sizeof *c);
done:
  fs_release(ctx, x);
  fs_problem_free(ctx, s.problem);
  return status;
}

static fs_status check_start(fs_context *ctx, setup *s, const fs_energy *energy) {
  fs_status status = FS_OK;
  int32_t face = FS_NONE;
  if (isfinite(energy->F) && isfinite(energy->gradient)) return FS_OK;
  FS_TRY(fs_problem_find_singular(s->problem, &face));
  status = fs_fail(ctx, FS_ERR_NUMERIC, "the surface is not regular on face %d: p_u x p_v = 0 at a quadrature node", face);
done:
  return status;
}

fs_status fs_fair(fs_context *ctx, const fs_space *space, const fs_fair_options *options, fs_vec3 *c,
                  fs_fair_report *report) {
  fs_status status = FS_OK;
  setup s = {0};
  double *x = NULL, *g = NULL;
  fs_vec3 *start = NULL;
  fs_fair_report r = {.n_squares = space->n_elements, .n_caps = space->n_caps};
  fs_minimise_report m = {.stop = FS_MINIMISE_GRADIENT};
  course course = {.options = options, .report = &r};
  clock_gettime(CLOCK_MONOTONIC, &course.start);
  FS_TRY(setup_create(ctx, space, options, options->functional != NULL ? options->functional : fs_functionals[0], c, &s));
  r.n_free = s.problem->n_free;
  r.c = s.c;
  FS_ALLOC(ctx, g, 3 * (size_t)r.n_free);
  FS_ALLOC(ctx, x, 3 * (size_t)r.n_free);
  FS_TRY(measure(&s, g, &r.start));
  r.end = r.start;
  if (r.n_free > 0 && options->max_iterations >= 0) {
    if (options->start_triharmonic) {
      FS_ALLOC(ctx, start, space->n_dofs);
      memcpy(start, c, (size_t)space->n_dofs * sizeof *c);
      FS_TRY(start_triharmonic(ctx, space, options, start));
      memcpy(s.problem->c, start, (size_t)space->n_dofs * sizeof *c);
      FS_TRY(measure(&s, g, &r.end));
    }
    FS_TRY(check_start(ctx, &s, &r.end));
    fs_problem_get(s.problem, x);
    FS_TRY(minimise(ctx, &s, options, &course, x, &m));
    fs_problem_set(s.problem, x);
    FS_TRY(measure(&s, g, &r.end));
    memcpy(c, s.problem->c, (size_t)space->n_dofs * sizeof *c);
  } else if (options->max_iterations < 0) {
    m.stop = FS_MINIMISE_ITERATIONS;
  }
  r.stop = (fs_stop)m.stop;
  r.n_steps = m.n_steps;
  r.n_hessians = m.n_hessians;
  r.n_factorisations = m.n_factorisations;
  if (report != NULL) *report = r;
done:
  fs_release(ctx, x);
  fs_release(ctx, g);
  fs_release(ctx, start);
  fs_problem_free(ctx, s.problem);
  return status;
}

fs_status fs_fair_energy(fs_context *ctx, const fs_space *space, const fs_fair_options *options, const fs_vec3 *c,
                         fs_energy *energy) {
  fs_status status = FS_OK;
  setup s = {0};
  double *g = NULL;
  FS_TRY(setup_create(ctx, space, options, options->functional != NULL ? options->functional : fs_functionals[0], c, &s));
  FS_ALLOC(ctx, g, 3 * (size_t)s.problem->n_free);
  FS_TRY(measure(&s, g, energy));
done:
  fs_release(ctx, g);
  fs_problem_free(ctx, s.problem);
  return status;
}

const char *fs_stop_text(fs_stop stop) {
  static const char *const text[] = {"gradient", "step", "decrease", "iterations", "cancelled"};
  return text[stop];
}
