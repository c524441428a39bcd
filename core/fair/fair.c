/* SPDX-License-Identifier: MIT */
/* Single role: the course of a fairing: stages, their report, the best iterate at the end.

   A functional with a continued parameter C (curvature variation) is minimised for C = 1e-2, 1e-3, … down to its value: few
   Newton-like steps each, and a unique result, where the last C alone would need many and may end elsewhere. All but the last
   stage stop early, and run with few quadrature nodes, as does the way to the neighbourhood of a minimum; the last steps see
   all nodes and converge quadratically. As C falls, minima turn into saddles, at which symmetric surfaces would stay: where
   the last factorisation of a stage does not show a minimum, fs_leave_saddle looks for the way down. */
#include "fair/along_normals.h"
#include "base/clock.h"
#include "fair/course.h"
#include "fair/smooth_start.h"

#include <math.h>
#include <string.h>

/* Fewer free dofs are quicker at once. Coarser meshes than these move too little of what the fine one needs: each step costs the
   integrals of the fine surface. */
enum { LEAST_FREE = 600, LEAST_COARSE = 100, LEAST_SHARE = 90 };

static fs_status run_stages(fs_course *c) {
  fs_status status = FS_OK;
  fs_stage stages[FS_MAX_STAGES];
  double last = c->setup.param[0];
  int32_t n = fs_stages_plan(&c->setup, c->options, c->n_coarse, stages);
  bool is_over = false;
  /* coarse displacements are smooth and trials cheap: far less damping than a raw mesh needs */
  c->damping.nu = fs_is_quadratic(c->setup.functional) ? 0 : c->n_coarse > 0 && !c->setup.has_metric ? 1e-3 : 1;
  for (int32_t i = 0; i < n && !is_over; i++) {
    if (c->options->along_normals) stages[i].depth = 1;
    FS_TRY(fs_course_run_stage(c, &stages[i], &is_over));
  }
  if (c->setup.wall != NULL) FS_TRY(fs_course_press_to_wall(c, &stages[n - 1], is_over));
done:
  if (c->depth > 0) fs_course_leave_depth(c); /* stopped there */
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
static fs_status begin_triharmonic(fs_course *c, const fs_space *space) {
  fs_status status = FS_OK;
  fs_fair_report unused = {0};
  fs_fair_options options = {.fixed = c->options->fixed,
                             .constraints = c->options->constraints,
                             .n_nodes_square = c->options->n_nodes_square,
                             .n_nodes_cap = c->options->n_nodes_cap,
                             .max_iterations = 4};
  fs_course linear = {.ctx = c->ctx, .options = &options, .report = &unused, .x = c->x, .g = c->g};
  FS_TRY(
      fs_setup_create(c->ctx, space, &options, fs_functional_find("triharmonic"), c->setup.problem->c, &linear.setup));
  fs_setup_share(&linear.setup, &c->setup);
  FS_TRY(run_stages(&linear));
  fs_setup_place(&c->setup, c->x);
done:
  fs_course_leave_depth(&linear);
  fs_setup_share(&linear.setup, NULL);
  fs_setup_free(c->ctx, &linear.setup);
  return status;
}

static fs_status run_course(fs_course *c, const fs_space *space) {
  fs_status status = FS_OK;
  fs_problem *p = c->setup.problem;
  const fs_constraints *constraints = c->options->constraints;
  bool is_scale_free = c->setup.functional->is_scale_free;
  double size = 0, size_now = 0;
  int32_t least = p->n_free / LEAST_SHARE > LEAST_COARSE ? p->n_free / LEAST_SHARE : LEAST_COARSE;
  fs_energy begin = c->report->start;
  if (is_scale_free) FS_TRY(fs_setup_size(&c->setup, &size)); /* of the start as it was given */
  fs_setup_place(&c->setup, c->x);
  if (constraints != NULL && constraints->tolerance != 0) FS_TRY(fs_course_begin_near(c));
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
    FS_TRY(fs_coarse_create(c->ctx, p, c->options->mesh, least, c->coarse, &c->n_coarse));
  c->report->n_coarse = c->n_coarse;
  c->setup.has_metric = !c->options->along_normals && c->setup.wall == NULL && fs_setup_metric_weight(&c->setup) > 0;
  FS_TRY(run_stages(c));
  FS_TRY(fs_problem_set_level(p, 0));
  fs_setup_place(&c->setup, c->x);
  if (is_scale_free) FS_TRY(fs_setup_restore_size(&c->setup, size));
  if (constraints != NULL && constraints->symmetry != NULL) fs_symmetry_apply(constraints->symmetry, p->c);
  if (is_scale_free) FS_TRY(fs_setup_size(&c->setup, &size_now));
  c->report->kept = is_scale_free ? size_now / size - 1 : 0;
  FS_TRY(fs_setup_measure(&c->setup, c->g, &c->report->end));
done:
  fs_course_leave_depth(c);
  return status;
}

static int32_t count_free_inner(const fs_problem *p) {
  int32_t n = 0;
  for (int32_t d = p->space->n_vertices; d < p->space->n_dofs; d++) n += p->unknown[d] != FS_NONE;
  return n;
}

/* The options' fixed dofs are those and all inner coefficients. */
static fs_status fix_inner(fs_course *c, const fs_space *space, fs_fair_options *own) {
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
static fs_status begin_constraints(fs_course *c, const fs_space *space, const fs_vec3 *dofs, fs_fair_options *own) {
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
  fs_course c = {.ctx = ctx, .options = &own, .report = &r};
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
