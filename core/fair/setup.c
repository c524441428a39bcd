/* SPDX-License-Identifier: MIT */
/* Single role: space, functional and fixed dofs become a function of the free dofs. */
#include "fair/setup.h"
#include "base/clock.h"

#include <math.h>
#include <string.h>

/* ---- from options to a problem ----------------------------------------------------------------------------------- */

enum { NODES_SQUARE = 8, NODES_CAP = 12, MAX_NODES = 32 };

static int32_t find_or_add_term(const fs_density **term, int32_t *n, const fs_density *density) {
  for (int32_t t = 0; t < *n; t++)
    if (term[t] == density) return t;
  term[*n] = density;
  return (*n)++;
}

static fs_status set_params(fs_context *ctx, const fs_fair_options *options, fs_setup *s) {
  const fs_param *params = s->functional->params;
  for (int i = 0; params != NULL && params[i].name != NULL && i < FS_MAX_FUNCTIONAL_PARAMS; i++) {
    s->param[i] = options->param != NULL ? options->param[i] : params[i].initial;
    if (!(s->param[i] >= params[i].min && s->param[i] <= params[i].max))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "parameter %s of %s is %g: %g to %g are possible", params[i].name,
                     s->functional->name, s->param[i], params[i].min, params[i].max);
  }
  return FS_OK;
}

fs_status fs_setup_create(fs_context *ctx, const fs_space *space, const fs_fair_options *options,
                          const fs_functional *functional, const fs_vec3 *c, fs_setup *s) {
  fs_status status = FS_OK;
  const fs_density *term[FS_MAX_TERMS + 2];
  int32_t square = options->n_nodes_square, cap = options->n_nodes_cap, n;
  bool is_fixed;
  *s = (fs_setup){.functional = functional, .term_A = FS_NONE};
  FS_TRY(fs_scale_find(ctx, space, options, c, &s->scale, &is_fixed));
  if (!is_fixed && functional->when_nothing_is_fixed != NULL) s->functional = functional->when_nothing_is_fixed;
  if (!is_fixed && !s->functional->is_scale_free)
    return fs_fail(ctx, FS_ERR_UNSUPPORTED, "nothing is fixed, and %s depends on the size or the place: fix vertices",
                   s->functional->name);
  if (is_fixed && s->functional->is_scale_free)
    return fs_fail(ctx, FS_ERR_UNSUPPORTED, "%s is for surfaces of which nothing is fixed", s->functional->name);
  if (square == 0) square = NODES_SQUARE;
  if (cap == 0) cap = NODES_CAP;
  if (square < 1 || square > MAX_NODES || cap < 1 || cap > MAX_NODES)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%d nodes on squares and %d in caps: 1 to %d are possible", square, cap,
                   MAX_NODES);
  n = s->functional->n_terms;
  if (n < 1 || n > FS_MAX_TERMS - 2)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the functional %s has %d terms: 1 to %d are possible", s->functional->name, n,
                   FS_MAX_TERMS - 2);
  for (int32_t t = 0; t < n; t++) {
    term[t] = s->functional->term[t];
    if (term[t] == &fs_density_area) s->term_A = t;
  }
  s->term_S = find_or_add_term(term, &n, &fs_density_curvature_variation);
  s->term_Q = find_or_add_term(term, &n, &fs_density_tangential);
  FS_TRY(set_params(ctx, options, s));
  FS_TRY(fs_problem_create(ctx, space, n, term, options->fixed, square, cap, c, &s->problem));
  if (options->constraints != NULL && options->constraints->keep == FS_KEEP_VOLUME) FS_TRY(fs_setup_keep_volume(s));
done:
  return status;
}

void fs_setup_free(fs_context *ctx, fs_setup *s) {
  fs_reduction_free(ctx, s->reduction);
  fs_sparse_free(ctx, s->reduced);
  fs_release(ctx, s->metric.value);
  fs_release(ctx, s->x);
  fs_release(ctx, s->g);
  fs_volume_free(s->volume);
  fs_volume_free(s->normals);
  fs_wall_free(s->wall);
  fs_problem_free(ctx, s->problem);
  s->problem = NULL;
  s->reduction = NULL;
  s->reduced = NULL;
  s->x = s->g = NULL;
  s->volume = s->normals = NULL;
  s->wall = NULL;
  s->metric.value = NULL;
}

/* ---- fewer unknowns ---------------------------------------------------------------------------------------------- */

fs_status fs_setup_reduce(fs_setup *s, fs_reduction *reduction) {
  fs_status status = FS_OK;
  fs_context *ctx = s->problem->ctx;
  int64_t *set_start = NULL;
  int32_t *member = NULL;
  fs_reduction_free(ctx, s->reduction);
  fs_sparse_free(ctx, s->reduced);
  fs_release(ctx, s->metric.value);
  s->metric.value = NULL;
  s->reduction = reduction;
  s->reduced = NULL;
  FS_TRY(fs_problem_reduce(s->problem, NULL));
  if (reduction == NULL) return FS_OK;
  if (s->x == NULL) FS_ALLOC(ctx, s->x, 3 * (size_t)s->problem->n_free);
  if (s->g == NULL) FS_ALLOC(ctx, s->g, 3 * (size_t)s->problem->n_free);
  FS_TRY(fs_problem_sets(s->problem, &set_start, &member));
  FS_TRY(fs_reduction_pattern(ctx, reduction, s->problem->space->n_elements, set_start, member, &s->reduced));
done:
  fs_release(ctx, set_start);
  fs_release(ctx, member);
  return status;
}

void fs_setup_share(fs_setup *s, const fs_setup *from) {
  s->reduction = from != NULL ? from->reduction : NULL;
  s->reduced = from != NULL ? from->reduced : NULL;
  s->x = from != NULL ? from->x : NULL;
  s->g = from != NULL ? from->g : NULL;
}

int32_t fs_setup_n(const fs_setup *s) { return s->reduction != NULL ? s->reduction->n_columns : s->problem->n_free; }

const fs_sparse *fs_setup_pattern(const fs_setup *s) { return s->reduction != NULL ? s->reduced : s->problem->pattern; }

void fs_setup_place(fs_setup *s, const double *y) {
  if (s->reduction == NULL) {
    fs_problem_set(s->problem, y);
    return;
  }
  fs_reduction_apply(s->reduction, y, s->x);
  fs_problem_set(s->problem, s->x);
}

double fs_setup_c(const fs_setup *s) { return s->term_Q < s->functional->n_terms ? s->problem->weight[s->term_Q] : 0; }

/* ---- values ------------------------------------------------------------------------------------------------------ */

/* integral[term_A] becomes what stands for it; the weight of the volume, the derivative of the functional by it, follows
   from that of the area, which becomes 0. */
static void put_volume(const fs_setup *s, double volume, double *integral) {
  double size = s->volume_sign * volume;
  integral[s->term_A] = size > 0 ? s->volume_factor * cbrt(size * size) : NAN;
}
static double take_weight(fs_setup *s, double volume) {
  double by_area = s->problem->weight[s->term_A];
  s->problem->weight[s->term_A] = 0;
  return s->volume_sign * by_area * s->volume_factor * 2 / 3 / cbrt(s->volume_sign * volume);
}

/* The functional at problem->c with the derivatives asked for. Where its derivatives by the integrals depend on the integrals,
   these are computed first. Second derivatives by the integrals are left out of the Hessian: for a functional that is free of
   scale they vanish on steps that keep the area, or the volume that stands for it. */
static fs_status evaluate(fs_setup *s, fs_order order, double *integral, double *caps, double *f, double *g,
                          fs_sparse *hessian) {
  fs_status status = FS_OK;
  double unused[FS_MAX_TERMS + 2], volume = 0, by_volume = 0, area;
  if (s->volume != NULL) FS_TRY(fs_volume_evaluate(s->volume, FS_VALUE, 0, &volume, NULL, NULL));
  if (order > FS_VALUE && !s->functional->is_linear) {
    FS_TRY(fs_problem_evaluate(s->problem, FS_VALUE, integral, NULL, NULL, NULL));
    if (s->volume != NULL) put_volume(s, volume, integral);
    s->functional->combine(s->param, &s->scale, integral, f, s->problem->weight);
    if (s->volume != NULL) by_volume = take_weight(s, volume);
  } else if (s->functional->is_linear) {
    memset(unused, 0, sizeof unused);
    s->functional->combine(s->param, &s->scale, unused, f, s->problem->weight);
  }
  FS_TRY(fs_problem_evaluate(s->problem, order, integral, caps,
                             order >= FS_HESSIAN && s->problem->reduction != NULL ? NULL : g, hessian));
  if (s->volume != NULL && order > FS_VALUE) FS_TRY(fs_volume_evaluate(s->volume, order, by_volume, NULL, g, hessian));
  area = s->volume != NULL ? integral[s->term_A] : 0;
  if (s->volume != NULL) put_volume(s, volume, integral);
  s->functional->combine(s->param, &s->scale, integral, f, unused);
  if (s->volume != NULL) integral[s->term_A] = area;
done:
  return status;
}

fs_status fs_setup_measure(fs_setup *s, double *g, fs_energy *energy) {
  fs_status status = FS_OK;
  fs_energy e = {0};
  double all[FS_MAX_TERMS + 2], caps[FS_MAX_TERMS + 2];
  FS_TRY(evaluate(s, FS_GRADIENT, all, caps, &e.F, g, NULL));
  for (int32_t t = 0; t < s->functional->n_terms; t++) {
    e.integral[t] = all[t];
    e.integral_caps[t] = caps[t];
    e.weight[t] = s->problem->weight[t];
  }
  e.S = all[s->term_S];
  e.S_caps = caps[s->term_S];
  e.Q = all[s->term_Q];
  if (s->reduction != NULL) fs_reduction_gather(s->reduction, g, s->x);
  for (size_t i = 0; i < 3 * (size_t)fs_setup_n(s); i++)
    e.gradient += s->reduction != NULL ? s->x[i] * s->x[i] : g[i] * g[i];
  e.gradient = sqrt(e.gradient);
  *energy = e;
done:
  return status;
}

static void count_costs(fs_setup *s, fs_order order, double seconds) {
  const fs_problem *p = s->problem;
  double points = 0;
  for (int32_t i = 0; i < p->space->n_elements; i++) {
    int32_t n = p->table[p->space->element[i].extraction]->n_nodes;
    points += (double)n * n;
  }
  if (order == FS_GRADIENT) {
    s->costs.n_gradients++;
    s->costs.points_of_gradients += points;
    s->costs.gradients += seconds;
  } else {
    s->costs.n_hessians++;
    s->costs.points_of_hessians += points;
    s->costs.hessians += seconds;
  }
}

static fs_status at(fs_setup *s, fs_order order, const double *x, double *f, double *g, fs_sparse *hessian) {
  fs_status status = FS_OK;
  double integral[FS_MAX_TERMS + 2];
  bool is_reduced = s->reduction != NULL;
  bool is_after = is_reduced && s->problem->reduction == NULL; /* else elements are reduced one by one */
  int32_t level = s->problem->level;
  double *full_g = g;
  fs_sparse *full_hessian = hessian;
  double begin = fs_clock_processor_seconds();
  fs_setup_place(s, x);
  if (order == FS_HESSIAN && level == FS_NODES_ALL && s->has_near_hessians) {
    FS_TRY(fs_problem_set_level(s->problem, s->n_cheap_hessians > 0 ? FS_NODES_FEW : FS_NODES_NEARLY_ALL));
    s->n_cheap_hessians--;
  }
  FS_TRY(fs_progress(s->problem->ctx, "fairing", 0));
  if (is_reduced) full_g = s->g;
  if (is_after) full_hessian = s->problem->pattern;
  FS_TRY(evaluate(s, order, integral, NULL, f, full_g, full_hessian));
  if (s->wall != NULL) FS_TRY(fs_wall_add(s->wall, order, f, full_g, full_hessian));
  if (is_reduced && (order == FS_GRADIENT || is_after)) fs_reduction_gather(s->reduction, s->g, g);
  if (is_after && order >= FS_HESSIAN)
    FS_TRY(fs_reduction_hessian(s->problem->ctx, s->reduction, s->problem->pattern, hessian));
  count_costs(s, order, fs_clock_processor_seconds() - begin);
done:
  if (s->problem->level != level) s->problem->table = s->problem->tables[s->problem->level = level];
  return status;
}

static fs_status gradient(void *self, const double *x, double *f, double *g) {
  return at(self, FS_GRADIENT, x, f, g, NULL);
}
static fs_status hessian(void *self, const double *x, double *f, double *g, fs_sparse *h) {
  return at(self, FS_HESSIAN, x, f, g, h);
}

/* The gradient of the area alone, or of the volume. */
static fs_status normal(void *self, const double *x, double *v) {
  fs_setup *s = self;
  fs_problem *p = s->problem;
  double kept[FS_MAX_TERMS + 2], *g = s->reduction != NULL ? s->g : v;
  fs_status status;
  fs_setup_place(s, x);
  if (s->volume != NULL) {
    memset(g, 0, 3 * (size_t)p->n_free * sizeof *g);
    status = fs_volume_evaluate(s->volume, FS_GRADIENT, 1, NULL, g, NULL);
  } else {
    memcpy(kept, p->weight, sizeof kept);
    memset(p->weight, 0, sizeof p->weight);
    p->weight[s->term_A] = 1;
    status = fs_problem_evaluate(p, FS_GRADIENT, NULL, NULL, g, NULL);
    memcpy(p->weight, kept, sizeof kept);
  }
  if (s->reduction != NULL) fs_reduction_gather(s->reduction, s->g, v);
  return status;
}

#define METRIC_C 1e-2

double fs_setup_metric_weight(const fs_setup *s) {
  double param[FS_MAX_FUNCTIONAL_PARAMS], integral[FS_MAX_TERMS + 2] = {0}, weight[FS_MAX_TERMS + 2] = {0}, f;
  if (!s->functional->is_linear || s->term_Q >= s->functional->n_terms) return 0;
  memcpy(param, s->param, sizeof param);
  param[0] = fmax(param[0], METRIC_C);
  s->functional->combine(param, &s->scale, integral, &f, weight);
  return weight[s->term_Q];
}

/* The problem becomes the integral of Q with this weight, normals held; undone by putting back what it was. */
static void leave_only_Q(fs_problem *p, int32_t term_Q, double weight) {
  memset(p->weight, 0, sizeof p->weight);
  p->weight[term_Q] = weight;
  p->term[term_Q] = &fs_density_tangential_held;
  p->sum[term_Q] = fs_kernels_sum_of(p->kernels, &fs_density_tangential_held);
}

/* The Hessian of Q with the weight that it has where C is METRIC_C or more: damping by nu is like raising C to nu METRIC_C, as
   seen from x. It changes little on the way, and is made once for all steps with the same unknowns. */
static fs_status metric(void *self, const double *x, const fs_sparse **result) {
  fs_status status = FS_OK;
  fs_setup *s = self;
  fs_problem *p = s->problem, kept = *p;
  bool by_element = p->reduction != NULL, is_summed_later = s->reduction != NULL && !by_element;
  *result = &s->metric;
  if (s->metric.value != NULL) return FS_OK;
  s->metric = *fs_setup_pattern(s);
  s->metric.value = NULL;
  FS_ALLOC(p->ctx, s->metric.value, 9 * (size_t)s->metric.col_start[s->metric.n_blocks]);
  fs_setup_place(s, x);
  leave_only_Q(p, s->term_Q, fs_setup_metric_weight(s));
  FS_TRY(fs_problem_set_level(p, by_element ? FS_NODES_LEAST : FS_NODES_FEW));
  FS_TRY(fs_problem_evaluate(p, FS_HESSIAN, NULL, NULL, NULL, is_summed_later ? p->pattern : &s->metric));
  if (is_summed_later) FS_TRY(fs_reduction_hessian(p->ctx, s->reduction, p->pattern, &s->metric));
done:
  memcpy(p->weight, kept.weight, sizeof p->weight);
  p->term[s->term_Q] = kept.term[s->term_Q];
  p->sum[s->term_Q] = kept.sum[s->term_Q];
  p->level = kept.level;
  p->table = p->tables[p->level];
  if (status != FS_OK) {
    fs_release(p->ctx, s->metric.value);
    s->metric.value = NULL;
  }
  return status;
}

fs_objective fs_setup_objective(fs_setup *s, fs_solver *solver) {
  return (fs_objective){.n = fs_setup_n(s),
                        .pattern = fs_setup_pattern(s),
                        .solver = solver,
                        .self = s,
                        .gradient = gradient,
                        .hessian = hessian,
                        .metric = s->has_metric ? metric : NULL,
                        .normal = s->functional->is_scale_free ? normal : NULL};
}
