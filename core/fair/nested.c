/* SPDX-License-Identifier: MIT */
/* Single role: coarse surfaces are faired before fine ones (nested iteration, [Brandt 1977]).

     x_coarse = least squares solution of  P x_coarse = x,   x += P (fair(x_coarse) - x_coarse)

   P is the refinement matrix. A coarse surface costs a fourth of the next finer one, and is only a way to a good start:
   what matters is its displacement, so that it need not be the same surface. Coarse vertices that move a fixed vertex, and
   those at the rim of the coarse surface, are fixed, so that the displacement ends smoothly. */
#include "fair/nested.h"
#include "fair/smooth_start.h"
#include "math/vec3.h"
#include "refine/refine.h"

#include <math.h>
#include <string.h>

enum { LEAST_COARSE = 50, FIT_STEPS = 30 };
/* Of coarse stages: predicted decrease, relative. Steps are cheap here; what is left goes on where they are not. */
static const double TOLERANCE = 1e-5, TOLERANCE_OF_ROUGH = 1e-4;

/* A mesh on the way down: level 0 is the course's. */
typedef struct nest {
  fs_course *course; /* that of level 0 */
  const struct nest *finer;
  const fs_mesh *mesh;
  const bool *fixed;    /* [mesh->n_vertices] */
  const fs_vec3 *begin; /* [mesh->n_vertices] before coarser displacements; of level 0 [n_dofs] */
  fs_stencils P;        /* from the coarser mesh to this one */
  fs_vec3 *work;        /* [mesh->n_vertices] for iterates; of level 0 [n_dofs] */
  bool *is_over;
} nest;

/* ---- between two meshes ------------------------------------------------------------------------------------------ */

static void apply(const fs_stencils *P, const fs_vec3 *y, fs_vec3 *x) {
  for (int32_t i = 0; i < P->n_rows; i++) {
    fs_vec3 sum = {0};
    for (int32_t k = P->start[i]; k < P->start[i + 1]; k++)
      sum = fs_vec3_add_scaled(sum, y[P->column[k]], P->weight[k]);
    x[i] = sum;
  }
}

static void apply_transposed(const fs_stencils *P, const fs_vec3 *x, fs_vec3 *y) {
  memset(y, 0, (size_t)P->n_columns * sizeof *y);
  for (int32_t i = 0; i < P->n_rows; i++)
    for (int32_t k = P->start[i]; k < P->start[i + 1]; k++)
      y[P->column[k]] = fs_vec3_add_scaled(y[P->column[k]], x[i], P->weight[k]);
}

static double dot(const fs_vec3 *a, const fs_vec3 *b, int32_t n) {
  double sum = 0;
  for (int32_t i = 0; i < n; i++) sum += fs_vec3_dot(a[i], b[i]);
  return sum;
}

/* Rows that sum to less than 1 miss vertices beyond the rim: they say nothing. */
static void forget_incomplete(const fs_stencils *P, fs_vec3 *x) {
  for (int32_t i = 0; i < P->n_rows; i++) {
    double sum = 0;
    for (int32_t k = P->start[i]; k < P->start[i + 1]; k++) sum += P->weight[k];
    if (sum < 1 - 1e-9) x[i] = (fs_vec3){0};
  }
}

/* y: in a guess, out nearly the least squares solution of P y = x, by conjugate gradients [Hestenes Stiefel 1952]. */
static fs_status fit(fs_context *ctx, const fs_stencils *P, const fs_vec3 *x, fs_vec3 *y) {
  fs_status status = FS_OK;
  fs_vec3 *r = NULL, *g = NULL, *d = NULL, *Pd = NULL;
  double square, first;
  FS_ALLOC(ctx, r, P->n_rows);
  FS_ALLOC(ctx, Pd, P->n_rows);
  FS_ALLOC(ctx, g, P->n_columns);
  FS_ALLOC(ctx, d, P->n_columns);
  apply(P, y, r);
  for (int32_t i = 0; i < P->n_rows; i++) r[i] = fs_vec3_sub(x[i], r[i]);
  forget_incomplete(P, r);
  apply_transposed(P, r, g);
  memcpy(d, g, (size_t)P->n_columns * sizeof *d);
  first = square = dot(g, g, P->n_columns);
  for (int step = 0; step < FIT_STEPS && square > 1e-20 * first; step++) {
    double before = square, alpha;
    apply(P, d, Pd);
    forget_incomplete(P, Pd);
    alpha = square / dot(Pd, Pd, P->n_rows);
    if (!isfinite(alpha)) break;
    for (int32_t i = 0; i < P->n_columns; i++) y[i] = fs_vec3_add_scaled(y[i], d[i], alpha);
    for (int32_t i = 0; i < P->n_rows; i++) r[i] = fs_vec3_add_scaled(r[i], Pd[i], -alpha);
    apply_transposed(P, r, g);
    square = dot(g, g, P->n_columns);
    for (int32_t i = 0; i < P->n_columns; i++) d[i] = fs_vec3_add_scaled(g[i], d[i], square / before);
  }
done:
  fs_release(ctx, r);
  fs_release(ctx, g);
  fs_release(ctx, d);
  fs_release(ctx, Pd);
  return status;
}

/* x += P (y - begin), but for fixed rows. */
static void add_displacement(const nest *l, const fs_vec3 *y, const fs_vec3 *begin, fs_vec3 *x) {
  const fs_stencils *P = &l->P;
  for (int32_t i = 0; i < P->n_rows; i++)
    for (int32_t k = P->start[i]; k < P->start[i + 1] && !l->fixed[i]; k++)
      x[i] = fs_vec3_add_scaled(x[i], fs_vec3_sub(y[P->column[k]], begin[P->column[k]]), P->weight[k]);
}

/* ---- one level --------------------------------------------------------------------------------------------------- */

/* An iterate of a coarse surface is shown as that of the finest. */
static bool show(void *user, const fs_step *step, const fs_vec3 *c) {
  const nest *l = user;
  const fs_fair_options *options = l->course->options;
  for (; l->finer != NULL; l = l->finer) {
    const nest *f = l->finer;
    int32_t n = f->finer != NULL ? f->mesh->n_vertices : l->course->setup.problem->space->n_dofs;
    memcpy(f->work, f->begin, (size_t)n * sizeof *c);
    add_displacement(f, c, l->begin, f->work);
    c = f->work;
  }
  return options->iterate(options->monitor_user, step, c);
}

static bool watch(void *user, const fs_step *step) {
  const fs_fair_options *options = ((const nest *)user)->course->options;
  return options->monitor(options->monitor_user, step);
}

static void add_costs(fs_costs *sum, const fs_costs *more) {
  sum->n_gradients += more->n_gradients;
  sum->n_hessians += more->n_hessians;
  sum->points_of_gradients += more->points_of_gradients;
  sum->points_of_hessians += more->points_of_hessians;
  sum->gradients += more->gradients;
  sum->hessians += more->hessians;
  sum->analysis += more->analysis;
  sum->factorisations += more->factorisations;
  sum->factor_flops = fmax(sum->factor_flops, more->factor_flops);
  sum->factor_bytes = fmax(sum->factor_bytes, more->factor_bytes);
}

/* Fairs the surface of a level from dofs x on: the coarsest with C lowered in stages, others with the last C. */
static fs_status fair_level(nest *l, const fs_space *space, const bool *fixed, fs_vec3 *x) {
  fs_status status = FS_OK;
  fs_course *fine = l->course;
  const fs_fair_options *given = fine->options;
  fs_constraints keep = {.keep = given->constraints != NULL ? given->constraints->keep : FS_KEEP_NOTHING};
  fs_fair_options options = *given;
  fs_course c = *fine;
  double tolerance = given->decrease_tolerance >= TOLERANCE_OF_ROUGH ? TOLERANCE_OF_ROUGH : TOLERANCE;
  double last = fine->setup.param[0], C = fs_stages_first(&fine->setup, fine->report->n_coarse);
  options.mesh = NULL;
  options.fixed = fixed;
  options.constraints = given->constraints != NULL ? &keep : NULL;
  options.param = fine->setup.param;
  options.monitor_user = l;
  if (given->iterate != NULL) options.iterate = show;
  if (given->monitor != NULL) options.monitor = watch;
  c.options = &options;
  c.x = c.y = c.g = NULL;
  c.solver = NULL;
  c.setup = (fs_setup){0};
  FS_TRY(fs_setup_create(c.ctx, space, &options, fs_setup_functional(&options), x, &c.setup));
  FS_ALLOC(c.ctx, c.x, 3 * (size_t)c.setup.problem->n_free);
  FS_ALLOC(c.ctx, c.g, 3 * (size_t)c.setup.problem->n_free);
  fs_problem_get(c.setup.problem, c.x);
  if (fine->report->n_coarse == 0) {
    fs_energy energy;
    FS_TRY(fs_setup_measure(&c.setup, c.g, &energy));
    if (!c.setup.functional->is_scale_free && isfinite(energy.F))
      FS_TRY(fs_smooth_start(&c.setup, &options, c.x, &energy));
    c.damping = (fs_damping){.nu = 1};
  } else {
    c.damping = (fs_damping){.nu = FS_FINER_DAMPING};
  }
  for (bool is_done = false; !is_done && !*l->is_over; C /= 10) {
    is_done = C <= 2 * last;
    fs_stage stage = {.C = is_done ? last : C, .level = 1, .tolerance = tolerance};
    FS_TRY(fs_course_run_stage(&c, &stage, l->is_over));
  }
  fine->report->n_coarse++;
  fs_setup_place(&c.setup, c.x);
  memcpy(x, c.setup.problem->c, (size_t)space->n_vertices * sizeof *x);
done:
  fs_course_leave_depth(&c);
  add_costs(&fine->setup.costs, &c.setup.costs);
  fine->n_earlier_steps = c.n_earlier_steps;
  fine->n_stages = c.n_stages;
  fine->is_out_of_time = c.is_out_of_time;
  fs_release(c.ctx, c.x);
  fs_release(c.ctx, c.g);
  fs_setup_free(c.ctx, &c.setup);
  return status;
}

/* The space of a coarse mesh, or NULL where it has none. */
static fs_status try_space(fs_context *ctx, const fs_mesh *mesh, fs_space **space) {
  fs_status status = fs_space_create(ctx, mesh, space);
  if (status != FS_ERR_UNSUPPORTED && status != FS_ERR_TOPOLOGY) return status;
  ctx->message[0] = '\0';
  *space = NULL;
  return FS_OK;
}

/* fixed[n_vertices of the coarse mesh]; returns how many vertices are free. */
static fs_status fix(fs_context *ctx, const nest *l, const fs_mesh *mesh, const fs_space *space, bool *fixed,
                     int32_t *n_free) {
  fs_status status = FS_OK;
  const fs_stencils *P = &l->P;
  FS_TRY(fs_space_rim(ctx, mesh, space, fixed));
  for (int32_t i = 0; i < P->n_rows; i++)
    for (int32_t k = P->start[i]; k < P->start[i + 1]; k++) fixed[P->column[k]] |= l->fixed[i];
  *n_free = 0;
  for (int32_t i = 0; i < mesh->n_vertices; i++) *n_free += !fixed[i];
done:
  return status;
}

/* Adds the displacements of coarser surfaces to the vertices x of a level. */
static fs_status descend(nest *l, fs_vec3 *x) {
  fs_status status = FS_OK;
  fs_context *ctx = l->course->ctx;
  fs_mesh *mesh = NULL;
  fs_space *space = NULL;
  int32_t *origin = NULL, n_free;
  bool *fixed = NULL;
  fs_vec3 *y = NULL, *begin = NULL;
  nest coarse = {.course = l->course, .finer = l, .is_over = l->is_over};
  FS_TRY(fs_mesh_coarsen(ctx, l->mesh, &mesh, &l->P, &origin));
  if (mesh == NULL) goto done;
  FS_TRY(try_space(ctx, mesh, &space));
  if (space == NULL) goto done;
  FS_ALLOC(ctx, fixed, space->n_dofs);
  FS_ALLOC(ctx, y, space->n_dofs);
  FS_ALLOC(ctx, begin, space->n_dofs);
  FS_TRY(fix(ctx, l, mesh, space, fixed, &n_free));
  if (n_free < LEAST_COARSE) goto done;
  memcpy(y, mesh->position, (size_t)mesh->n_vertices * sizeof *y);
  FS_TRY(fit(ctx, &l->P, x, y));
  memcpy(begin, y, (size_t)mesh->n_vertices * sizeof *y);
  coarse.mesh = mesh;
  coarse.fixed = fixed;
  coarse.begin = begin;
  if (l->course->options->iterate != NULL) FS_ALLOC(ctx, coarse.work, mesh->n_vertices);
  FS_TRY(descend(&coarse, y));
  if (!*l->is_over) FS_TRY(fair_level(&coarse, space, fixed, y));
  add_displacement(l, y, begin, x);
done:
  fs_stencils_release(ctx, &l->P);
  fs_release(ctx, coarse.work);
  fs_mesh_free(ctx, mesh);
  fs_space_free(ctx, space);
  fs_release(ctx, origin);
  fs_release(ctx, fixed);
  fs_release(ctx, y);
  fs_release(ctx, begin);
  return status;
}

fs_status fs_nested_start(fs_course *c, bool *is_over) {
  fs_status status = FS_OK;
  const fs_problem *p = c->setup.problem;
  const fs_space *space = p->space;
  bool *fixed = NULL;
  fs_vec3 *x = NULL;
  nest finest = {.course = c, .mesh = c->options->mesh, .is_over = is_over, .begin = p->c};
  FS_ALLOC(c->ctx, x, space->n_dofs);
  FS_ALLOC(c->ctx, fixed, space->n_vertices);
  if (c->options->iterate != NULL) FS_ALLOC(c->ctx, finest.work, space->n_dofs);
  fs_setup_place(&c->setup, c->x);
  memcpy(x, p->c, (size_t)space->n_dofs * sizeof *x);
  for (int32_t d = 0; d < space->n_vertices; d++) fixed[d] = p->unknown[d] == FS_NONE;
  finest.fixed = fixed;
  FS_TRY(descend(&finest, x));
  for (int32_t d = 0; d < space->n_vertices; d++)
    if (!fixed[d]) memcpy(c->x + 3 * (size_t)p->unknown[d], &x[d], sizeof *x);
done:
  fs_release(c->ctx, finest.work);
  fs_release(c->ctx, fixed);
  fs_release(c->ctx, x);
  return status;
}
