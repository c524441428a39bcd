/* SPDX-License-Identifier: MIT */
/* Single role: one stage of a fairing: its unknowns, the minimisation, what is reported of it. */
#include "fair/course.h"
#include "fair/along_normals.h"
#include "base/clock.h"

#include <math.h>
#include <string.h>

enum { NORMALS_KEPT = 3 }; /* steps along the same normals */
enum { MAX_ITERATIONS = 300, MAX_ITERATIONS_WALL = 400, MAX_SADDLES = 4 };
static const double FINER_DAMPING = 1e-6; /* to begin with after a coarser mesh */

static bool record(void *user, const fs_minimise_step *m) {
  fs_course *c = user;
  const fs_fair_options *options = c->options;
  fs_step step = {.number = m->number + c->n_earlier_steps,
                  .stage = c->n_stages,
                  .value = m->value,
                  .gradient = m->gradient,
                  .damping = m->damping,
                  .length = m->length,
                  .gain = m->gain,
                  .n_factorisations = m->n_factorisations,
                  .seconds = fs_clock_seconds() - c->start,
                  .c = fs_setup_c(&c->setup)};
  if (m->number == 0) c->begin_value = m->value;
  if (m->number == 0 && c->n_earlier_steps > 0) return true; /* the start of a later stage */
  c->last_damping = m->damping;
  if (c->first_damping == 0 && c->depth < c->n_coarse) c->first_damping = m->damping;
  if (c->report->n_trace < FS_MAX_TRACE) c->report->trace[c->report->n_trace++] = step;
  if (options->iterate != NULL) {
    fs_setup_place(&c->setup, c->depth > 0 ? c->y : c->x);
    if (!options->iterate(options->monitor_user, &step, c->setup.problem->c)) return false;
  }
  if (options->monitor != NULL && !options->monitor(options->monitor_user, &step)) return false;
  c->is_out_of_time = options->max_seconds > 0 && step.seconds >= options->max_seconds;
  return !c->is_out_of_time;
}

static void add_costs(fs_costs *costs, const fs_solver *solver) {
  fs_solver_costs more = fs_solver_get_costs(solver);
  costs->analysis += more.analysis;
  costs->factorisations += more.factorisations;
  costs->factor_flops = fmax(costs->factor_flops, more.flops);
  costs->factor_bytes = fmax(costs->factor_bytes, more.bytes);
}

void fs_course_leave_depth(fs_course *c) {
  if (c->solver != NULL) add_costs(&c->setup.costs, c->solver);
  fs_solver_free(c->ctx, c->solver);
  c->solver = NULL;
  fs_release(c->ctx, c->y);
  c->y = NULL;
  if (c->depth == 0) return;
  fs_setup_reduce(&c->setup, NULL);
  c->depth = 0;
}

/* The unknowns become displacements of the mesh so many refinements before, from x on. */
static fs_status enter_depth(fs_course *c, int32_t depth) {
  fs_status status = FS_OK;
  fs_reduction *reduction;
  if (c->solver != NULL && c->depth == depth) return FS_OK;
  fs_course_leave_depth(c);
  c->damping.is_factored = false;
  if (c->n_coarse > depth)
    c->damping = (fs_damping){.nu = c->setup.has_metric ? fmax(c->first_damping, 1) : FINER_DAMPING};
  c->first_damping = 0;
  if (depth > 0) {
    reduction = c->coarse[depth - 1];
    c->coarse[depth - 1] = NULL;
    c->depth = depth;
    memcpy(reduction->x0, c->x, 3 * (size_t)reduction->n_rows * sizeof *c->x);
    FS_TRY(fs_setup_reduce(&c->setup, reduction));
    if (reduction->weight != NULL) FS_TRY(fs_problem_reduce(c->setup.problem, reduction));
    FS_ALLOC(c->ctx, c->y, 3 * (size_t)reduction->n_columns);
  }
  FS_TRY(fs_solver_create(c->ctx, fs_setup_pattern(&c->setup), &c->solver));
done:
  return status;
}

static fs_status minimise(fs_course *c, const fs_stage *stage, const fs_objective *objective, bool *is_over) {
  fs_status status = FS_OK;
  const fs_fair_options *options = c->options;
  int32_t max_iterations = options->max_iterations;
  fs_minimise_report m;
  if (max_iterations == 0) max_iterations = c->setup.wall != NULL ? MAX_ITERATIONS_WALL : MAX_ITERATIONS;
  max_iterations -= c->n_earlier_steps;
  fs_minimise_options o = {.max_iterations =
                               options->along_normals && max_iterations > NORMALS_KEPT ? NORMALS_KEPT : max_iterations,
                           .decrease_tolerance = stage->tolerance,
                           .damping = &c->damping,
                           .least_damping = c->setup.functional->is_scale_free || c->setup.wall != NULL ? 1e-10 : 0,
                           .monitor = record,
                           .user = c};
  if (c->setup.wall != NULL) { /* the forces of the wall change after each stage */
    o.decrease_tolerance = fmax(o.decrease_tolerance, c->wall_tolerance);
  } else if (stage->is_last && stage->tolerance <= 1e-12 && !options->along_normals) {
    /* Hessians of small meshes cost little, and the steps converge quadratically. Else one Newton step to begin with: what failed
       on the way here tells nothing about the minimum, and an undamped factorisation proves that it is one. */
    o.is_newton = !c->setup.has_metric || c->n_coarse == 0;
    c->damping.is_factored = false;
    c->damping.nu_failed = 0;
    if (c->setup.has_metric) c->damping.nu = 0;
    o.gradient_tolerance = options->gradient_tolerance == 0 ? 1e-8 : options->gradient_tolerance;
    o.gradient_start = c->gradient_start;
  }
  FS_TRY(fs_minimise(c->ctx, objective, &o, c->depth > 0 ? c->y : c->x, &m));
  c->value = m.value;
  c->n_earlier_steps += m.n_steps;
  c->report->n_steps += m.n_steps;
  c->report->n_hessians += m.n_hessians;
  c->report->n_factorisations += m.n_factorisations;
  c->report->stop = c->is_out_of_time ? FS_STOP_TIME : (fs_stop)m.stop;
  *is_over = m.stop == FS_MINIMISE_CANCELLED || (m.stop == FS_MINIMISE_ITERATIONS && m.n_steps == max_iterations);
done:
  return status;
}

/* Along normals that are refreshed, until they bring no more. */
static fs_status minimise_along_normals(fs_course *c, const fs_stage *stage, const fs_objective *objective,
                                        bool *is_over) {
  fs_status status = FS_OK;
  double tolerance = fmax(stage->tolerance, 1e-9);
  do {
    FS_TRY(fs_along_normals_turn(&c->setup, c->x));
    memset(c->y, 0, 3 * (size_t)fs_setup_n(&c->setup) * sizeof *c->y);
    FS_TRY(minimise(c, stage, objective, is_over));
    fs_reduction_apply(c->setup.reduction, c->y, c->x);
  } while (!*is_over && c->begin_value - c->value > tolerance * fabs(c->value));
  if (c->report->stop == FS_STOP_ITERATIONS && !*is_over) c->report->stop = FS_STOP_DECREASE;
done:
  return status;
}

/* From a stationary point that need not be a minimum. *has_moved: far enough for the stage to go on. */
static fs_status leave_saddle(fs_course *c, const fs_objective *objective, double tolerance, bool *has_moved) {
  fs_status status = FS_OK;
  fs_saddle_report saddle = {0};
  c->setup.has_near_hessians = false;
  c->damping = (fs_damping){0};
  FS_TRY(fs_leave_saddle(c->ctx, objective, &c->damping.nu, c->x, &saddle));
  c->report->n_hessians++;
  c->report->n_factorisations += saddle.n_factorisations;
  c->report->n_saddles += saddle.has_moved;
  *has_moved = saddle.decrease > tolerance * fabs(c->value);
done:
  return status;
}

fs_status fs_course_run_stage(fs_course *c, const fs_stage *stage, bool *is_over) {
  fs_status status = FS_OK;
  fs_objective objective;
  bool has_moved = true;
  c->setup.has_near_hessians = stage->level == 0;
  c->setup.n_cheap_hessians = 1;
  c->setup.param[0] = stage->C;
  FS_TRY(fs_problem_set_level(c->setup.problem, stage->level));
  FS_TRY(enter_depth(c, stage->depth));
  objective = fs_setup_objective(&c->setup, c->solver);
  if (c->setup.wall != NULL && c->n_rounds == 0) FS_TRY(fs_course_stiffen_wall(c, &objective));
  if (c->options->along_normals) FS_TRY(minimise_along_normals(c, stage, &objective, is_over));
  for (int32_t round = 0; !c->options->along_normals && has_moved && !*is_over; round++) {
    FS_TRY(minimise(c, stage, &objective, is_over));
    has_moved = false;
    if (*is_over || !stage->is_minimum || c->setup.wall != NULL || round == MAX_SADDLES ||
        c->last_damping <= FS_DEFINITE_DAMPING)
      break;
    FS_TRY(leave_saddle(c, &objective, stage->tolerance, &has_moved));
  }
  fs_setup_place(&c->setup, c->depth > 0 ? c->y : c->x);
  if (c->setup.wall != NULL) FS_TRY(fs_wall_learn(c->setup.wall, &c->excess));
done:
  c->n_stages++;
  if (c->y != NULL) fs_reduction_apply(c->setup.reduction, c->y, c->x);
  if (status == FS_ERR_CANCELLED) { /* c->x is the best point met */
    c->report->stop = FS_STOP_CANCELLED;
    *is_over = true;
    status = FS_OK;
  }
  return status;
}
