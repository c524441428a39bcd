/* SPDX-License-Identifier: MIT */
/* Single role: the course of a fairing: stages, their report, the best iterate at the end.

   A functional with a continued parameter C (curvature variation) is minimised for C = 1e-2, 1e-3, … down to its value: few
   Newton-like steps each, and a unique result, where the last C alone would need many and may end elsewhere. All but the last
   stage stop early, and run with few quadrature nodes, as does the way to the neighbourhood of a minimum; the last steps see
   all nodes and converge quadratically. As C falls, minima turn into saddles, at which symmetric surfaces would stay: where
   the last factorisation of a stage does not show a minimum, fs_leave_saddle looks for the way down. */
#include "fair/along_normals.h"
#include "base/clock.h"
#include "fair/constrain.h"
#include "fair/smooth_start.h"
#include "fair/stages.h"
#include "fair/stay_near.h"

#include <math.h>
#include <string.h>

enum { NORMALS_KEPT = 3 }; /* steps along the same normals */
enum { MAX_ITERATIONS = 100, MAX_SADDLES = 4, MAX_ROUNDS = 12, WALL_SHARE = 100 };
static const double WALL_EXCESS = 0.004; /* relative to the tolerance */

/* Fewer free dofs are quicker at once; and the least number of coarse unknowns that is worth having. */
enum { LEAST_FREE = 1500, LEAST_COARSE = 200 };
static const double FINER_DAMPING = 1e-6; /* to begin with after a coarser mesh */

/* The whole fairing. */
typedef struct course {
  fs_context *ctx;
  const fs_fair_options *options;
  fs_fair_report *report;
  fs_setup setup;
  bool *fixed;      /* along normals: with the inner coefficients */
  fs_base base;     /* with linear constraints: the dofs by fewer numbers */
  int32_t n_coarse; /* depths that there are */
  fs_reduction *coarse[FS_MAX_COARSE];
  int32_t depth; /* of the solver and the unknowns */
  fs_solver *solver;
  fs_damping damping;
  double *x, *y, *g, gradient_start; /* x: the unknowns of depth 0; y: those of others, while they are */
  double *begin, excess;             /* with a wall: x at the start, and how far samples are beyond it */
  int32_t n_rounds;                  /* so many times the last stage was begun with the same wall */
  double start;                      /* seconds */
  int32_t n_earlier_steps;           /* of the stages before */
  int32_t n_stages;                  /* before */
  double last_damping;               /* in the last factorisation */
  double value, begin_value;         /* at x, and at the start of the last minimisation */
  bool is_out_of_time;
} course;

/* ---- stages ------------------------------------------------------------------------------------------------------ */

static bool record(void *user, const fs_minimise_step *m) {
  course *c = user;
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

/* Back to depth 0. */
static void leave_depth(course *c) {
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
static fs_status enter_depth(course *c, int32_t depth) {
  fs_status status = FS_OK;
  fs_reduction *reduction;
  if (c->solver != NULL && c->depth == depth) return FS_OK;
  leave_depth(c);
  c->damping.is_factored = false;
  if (c->n_coarse > depth) c->damping = (fs_damping){.nu = FINER_DAMPING};
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

/* A stiffness of the wall at which going as far again beyond it everywhere would cost many times the functional. */
static fs_status stiffen_wall(course *c, const fs_objective *objective) {
  fs_status status = FS_OK;
  fs_wall *wall = c->setup.wall;
  double f;
  c->setup.wall = NULL;
  status = objective->gradient(objective->self, c->x, &f, c->g);
  c->setup.wall = wall;
  if (status == FS_ERR_CANCELLED) return FS_OK; /* the minimisation will hear of it too */
  if (status != FS_OK) return status;
  wall->stiffness =
      WALL_SHARE * fabs(f) / ((double)wall->start[wall->problem->space->n_elements] * pow(wall->limit, 2));
  return FS_OK;
}

static fs_status minimise(course *c, const fs_stage *stage, const fs_objective *objective, bool *is_over) {
  fs_status status = FS_OK;
  const fs_fair_options *options = c->options;
  int32_t max_iterations = options->max_iterations;
  fs_minimise_report m;
  if (max_iterations == 0) max_iterations = c->setup.wall != NULL ? 4 * MAX_ITERATIONS : MAX_ITERATIONS;
  max_iterations -= c->n_earlier_steps;
  fs_minimise_options o = {.max_iterations =
                               options->along_normals && max_iterations > NORMALS_KEPT ? NORMALS_KEPT : max_iterations,
                           .decrease_tolerance = stage->tolerance,
                           .damping = &c->damping,
                           .least_damping = c->setup.functional->is_scale_free || c->setup.wall != NULL ? 1e-10 : 0,
                           .monitor = record,
                           .user = c};
  if (c->setup.wall != NULL) { /* the forces of the wall change after each stage */
    o.decrease_tolerance = fmax(o.decrease_tolerance, 1e-7);
  } else if (stage->is_last && stage->tolerance <= 1e-12 && !options->along_normals) {
    o.is_newton = true;
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
static fs_status minimise_along_normals(course *c, const fs_stage *stage, const fs_objective *objective,
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
static fs_status leave_saddle(course *c, const fs_objective *objective, double tolerance, bool *has_moved) {
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

static fs_status run_stage(course *c, const fs_stage *stage, bool *is_over) {
  fs_status status = FS_OK;
  fs_objective objective;
  bool has_moved = true;
  c->setup.has_near_hessians = stage->level == 0;
  c->setup.n_cheap_hessians = 1;
  c->setup.param[0] = stage->C;
  FS_TRY(fs_problem_set_level(c->setup.problem, stage->level));
  FS_TRY(enter_depth(c, stage->depth));
  objective = fs_setup_objective(&c->setup, c->solver);
  if (c->setup.wall != NULL && c->n_rounds == 0) FS_TRY(stiffen_wall(c, &objective));
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

/* Repeats the last stage until the forces hold the surface at the wall; what then still is beyond the tolerance goes back
   towards the start. */
static fs_status press_to_wall(course *c, const fs_stage *last, bool is_over) {
  fs_status status = FS_OK;
  fs_wall *wall = c->setup.wall;
  double tolerance = c->options->constraints->tolerance, distance, before;
  int32_t face;
  for (c->n_rounds = 1; c->n_rounds <= MAX_ROUNDS && !is_over; c->n_rounds++) {
    if (c->excess <= WALL_EXCESS * tolerance) {
      FS_TRY(fs_wall_measure(wall, &distance, &face));
      if (distance <= tolerance) break;
      wall->limit -= 1.1 * (distance - tolerance); /* there is more between the samples */
    }
    before = c->excess;
    FS_TRY(run_stage(c, last, &is_over));
    if (c->excess > 0.25 * before) wall->stiffness *= 4;
  }
  FS_TRY(fs_stay_near_retract(&c->setup, (1 - 1e-12) * tolerance, c->begin, c->x, &c->report->distance));
done:
  return status;
}

static fs_status run_stages(course *c) {
  fs_status status = FS_OK;
  fs_stage stages[FS_MAX_STAGES];
  double last = c->setup.param[0];
  int32_t n = fs_stages_plan(&c->setup, c->options, c->n_coarse, stages);
  bool is_over = false;
  /* coarse displacements are smooth and trials cheap: far less damping than a raw mesh needs */
  c->damping = (fs_damping){.nu = fs_is_quadratic(c->setup.functional) ? 0 : c->n_coarse > 0 ? 1e-3 : 1};
  for (int32_t i = 0; i < n && !is_over; i++) {
    if (c->options->along_normals) stages[i].depth = 1;
    FS_TRY(run_stage(c, &stages[i], &is_over));
  }
  if (c->setup.wall != NULL) FS_TRY(press_to_wall(c, &stages[n - 1], is_over));
done:
  if (c->depth > 0) leave_depth(c); /* stopped there */
  c->setup.param[0] = last;
  return status;
}

/* ---- fairing ----------------------------------------------------------------------------------------------------- */

static fs_status check_start(fs_context *ctx, fs_setup *s, const fs_energy *energy) {
  fs_status status = FS_OK;
  int32_t face = FS_NONE;
  if (isfinite(energy->F) && isfinite(energy->gradient)) return FS_OK;
  FS_TRY(fs_problem_find_singular(s->problem, &face));
  status =
      fs_fail(ctx, FS_ERR_NUMERIC, "the surface is not regular on face %d: p_u x p_v = 0 at a quadrature node", face);
done:
  return status;
}

/* problem->c = the minimum of the triharmonic functional with the same dofs fixed. */
static fs_status begin_triharmonic(course *c, const fs_space *space) {
  fs_status status = FS_OK;
  fs_fair_report unused = {0};
  fs_fair_options options = {.fixed = c->options->fixed,
                             .constraints = c->options->constraints,
                             .n_nodes_square = c->options->n_nodes_square,
                             .n_nodes_cap = c->options->n_nodes_cap,
                             .max_iterations = 4};
  course linear = {.ctx = c->ctx, .options = &options, .report = &unused, .x = c->x, .g = c->g};
  FS_TRY(
      fs_setup_create(c->ctx, space, &options, fs_functional_find("triharmonic"), c->setup.problem->c, &linear.setup));
  fs_setup_share(&linear.setup, &c->setup);
  FS_TRY(run_stages(&linear));
  fs_setup_place(&c->setup, c->x);
done:
  leave_depth(&linear);
  fs_setup_share(&linear.setup, NULL);
  fs_setup_free(c->ctx, &linear.setup);
  return status;
}

static fs_status begin_near(course *c) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)fs_setup_n(&c->setup);
  if (c->options->start_triharmonic)
    return fs_fail(c->ctx, FS_ERR_UNSUPPORTED, "a tolerance needs the start as it is, not the triharmonic surface");
  FS_ALLOC(c->ctx, c->begin, n);
  memcpy(c->begin, c->x, n * sizeof *c->begin);
  FS_TRY(fs_stay_near_begin(&c->setup, c->options->constraints, c->x));
done:
  return status;
}

static fs_status run_course(course *c, const fs_space *space) {
  fs_status status = FS_OK;
  fs_problem *p = c->setup.problem;
  const fs_constraints *constraints = c->options->constraints;
  bool is_scale_free = c->setup.functional->is_scale_free;
  double size = 0, size_now = 0;
  fs_energy begin = c->report->start;
  if (is_scale_free) FS_TRY(fs_setup_size(&c->setup, &size)); /* of the start as it was given */
  fs_setup_place(&c->setup, c->x);
  if (constraints != NULL && constraints->tolerance != 0) FS_TRY(begin_near(c));
  if (c->options->start_triharmonic) FS_TRY(begin_triharmonic(c, space));
  if (c->options->start_triharmonic || c->setup.reduction != NULL) FS_TRY(fs_setup_measure(&c->setup, c->g, &begin));
  FS_TRY(check_start(c->ctx, &c->setup, &begin));
  if (c->options->along_normals)
    FS_TRY(fs_along_normals_create(&c->setup, &c->coarse[0]));
  else if (!is_scale_free && c->setup.wall == NULL && !fs_is_quadratic(c->setup.functional))
    FS_TRY(fs_smooth_start(&c->setup, c->options, c->x, &begin));
  c->gradient_start = begin.gradient;
  if (c->options->mesh != NULL && !c->options->along_normals && c->setup.reduction == NULL && c->setup.wall == NULL &&
      p->n_free >= LEAST_FREE)
    FS_TRY(fs_coarse_create(c->ctx, p, c->options->mesh, LEAST_COARSE, c->coarse, &c->n_coarse));
  c->report->n_coarse = c->n_coarse;
  FS_TRY(run_stages(c));
  FS_TRY(fs_problem_set_level(p, 0));
  fs_setup_place(&c->setup, c->x);
  if (is_scale_free) FS_TRY(fs_setup_restore_size(&c->setup, size));
  if (constraints != NULL && constraints->symmetry != NULL) fs_symmetry_apply(constraints->symmetry, p->c);
  if (is_scale_free) FS_TRY(fs_setup_size(&c->setup, &size_now));
  c->report->kept = is_scale_free ? size_now / size - 1 : 0;
  FS_TRY(fs_setup_measure(&c->setup, c->g, &c->report->end));
done:
  leave_depth(c);
  return status;
}

static int32_t count_free_inner(const fs_problem *p) {
  int32_t n = 0;
  for (int32_t d = p->space->n_vertices; d < p->space->n_dofs; d++) n += p->unknown[d] != FS_NONE;
  return n;
}

/* The options' fixed dofs are those and all inner coefficients. */
static fs_status fix_inner(course *c, const fs_space *space, fs_fair_options *own) {
  fs_status status = FS_OK;
  FS_ALLOC(c->ctx, c->fixed, space->n_dofs);
  for (int32_t d = 0; d < space->n_dofs; d++)
    c->fixed[d] = d >= space->n_vertices || (own->fixed != NULL && own->fixed[d]);
  own->fixed = c->fixed;
done:
  return status;
}

/* The setup; with linear constraints in fewer unknowns, which then are set in c->x. *own: options with what is fixed by
   symmetry too. */
static fs_status begin_constraints(course *c, const fs_space *space, const fs_vec3 *dofs, fs_fair_options *own) {
  fs_status status = FS_OK;
  const fs_constraints *k = own->constraints;
  const fs_functional *functional = fs_setup_functional(own);
  if (own->along_normals && k != NULL &&
      (k->n_holds > 0 || k->n_equations > 0 || k->symmetry != NULL || k->tolerance > 0))
    return fs_fail(c->ctx, FS_ERR_UNSUPPORTED, "points, equations, symmetry and distances are not kept along normals");
  if (own->along_normals) FS_TRY(fix_inner(c, space, own));
  if (k == NULL || (k->n_holds == 0 && k->n_equations == 0 && k->symmetry == NULL))
    return fs_setup_create(c->ctx, space, own, functional, dofs, &c->setup);
  FS_TRY(fs_base_create(c->ctx, space, own->fixed, k->symmetry, dofs, &c->base));
  own->fixed = c->base.is_constant;
  FS_TRY(fs_setup_create(c->ctx, space, own, functional, c->base.c, &c->setup));
  FS_TRY(fs_constrain_setup(c->ctx, space, k, &c->base, &c->setup, &c->x));
done:
  return status;
}

fs_status fs_fair(fs_context *ctx, const fs_space *space, const fs_fair_options *options, fs_vec3 *dofs,
                  fs_fair_report *report) {
  fs_status status = FS_OK;
  fs_fair_report r = {.n_squares = space->n_elements, .n_caps = space->n_caps};
  fs_fair_options own = *options;
  course c = {.ctx = ctx, .options = &own, .report = &r};
  c.start = fs_clock_seconds();
  FS_TRY(begin_constraints(&c, space, dofs, &own));
  if (options->polish && !c.setup.functional->is_continued) {
    status = fs_fail(ctx, FS_ERR_ARGUMENT, "%s has no weight that is lowered: there is nothing to polish",
                     c.setup.functional->name);
    goto done;
  }
  if (options->polish) c.setup.param[0] *= FS_POLISH_FACTOR;
  r.functional = c.setup.functional;
  r.n_free = c.setup.problem->n_free;
  r.n_free_inner = count_free_inner(c.setup.problem);
  FS_ALLOC(ctx, c.g, 3 * (size_t)r.n_free);
  if (c.x == NULL) {
    FS_ALLOC(ctx, c.x, 3 * (size_t)r.n_free);
    fs_problem_get(c.setup.problem, c.x);
  }
  r.n_unknowns = fs_setup_n(&c.setup);
  FS_TRY(fs_setup_measure(&c.setup, c.g, &r.start));
  r.end = r.start;
  r.stop = options->max_iterations < 0 ? FS_STOP_ITERATIONS : FS_STOP_GRADIENT;
  if (r.n_unknowns > 0 && options->max_iterations >= 0) {
    FS_TRY(run_course(&c, space));
  } else if (c.setup.reduction != NULL && options->max_iterations >= 0) {
    fs_setup_place(&c.setup, c.x);
    FS_TRY(fs_setup_measure(&c.setup, c.g, &r.end));
  }
  r.c = fs_setup_c(&c.setup);
  r.costs = c.setup.costs;
  FS_TRY(fs_fair_quality(ctx, space, c.setup.problem->c, 0, 0, &r.quality));
  memcpy(dofs, c.setup.problem->c, (size_t)space->n_dofs * sizeof *dofs);
  if (report != NULL) *report = r;
done:
  for (int32_t i = 0; i < FS_MAX_COARSE; i++) fs_reduction_free(ctx, c.coarse[i]);
  fs_release(ctx, c.fixed);
  fs_release(ctx, c.x);
  fs_release(ctx, c.g);
  fs_release(ctx, c.begin);
  fs_setup_free(ctx, &c.setup);
  fs_base_free(ctx, &c.base);
  return status;
}
