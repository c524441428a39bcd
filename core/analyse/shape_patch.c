/* SPDX-License-Identifier: MIT */
/* Single role: integrals of a patch by Gauss-Legendre quadrature, halved where it is not fine enough yet.

   With n nodes per direction the rule is exact for degree 2 n - 1, and for smooth integrands its error falls with n as the
   square of their Legendre coefficients of degree n does. Those of degree n - 1 and n - 2 are sums over the same nodes,
     c_k = (2 k + 1) sum_i w_i P_k(2 x_i - 1) g_i,
   with the integrand g summed over the other direction; the square of their part of c_0 estimates the relative error. Where it
   is too large for one of the integrals, the domain is cut in four. Patches of three sides are the image of the square
   under (a, b) -> (a, b (1 - a)). */
#include "analyse/analyse.h"
#include "math/quadrature.h"
#include "surface/surface.h"

#include <math.h>

enum { MAX_DEPTH = 7, MAX_CELLS = 400 };

int32_t fs_patch_nodes(const fs_patch *patch) {
  int32_t degree = patch->degree_u > patch->degree_v ? patch->degree_u : patch->degree_v;
  int32_t n = (3 * degree + 1) / 2;    /* p . (p_u x p_v) has degree 3 degree - 1: exact */
  return n > 16 ? 24 : n > 8 ? 16 : 8; /* whole vectors */
}

fs_status fs_rules_create(fs_context *ctx, fs_rules **rules) {
  fs_rules *r = NULL;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, r, 1);
  for (int32_t n = 8; n <= FS_MAX_PATCH_NODES; n += 8) {
    FS_TRY(fs_gauss_legendre(ctx, n, r->node[n], r->weight[n]));
    for (int32_t i = 0; i < n; i++) {
      double x = 2 * r->node[n][i] - 1, p = 1, before = 0;
      for (int32_t k = 0; k < n; k++) { /* p = P_k, (k + 1) P_(k+1) = (2 k + 1) x P_k - k P_(k-1) */
        double next = ((2 * k + 1) * x * p - k * before) / (k + 1);
        if (k >= n - 2) r->legendre[n][k - n + 2][i] = (2 * k + 1) * r->weight[n][i] * p;
        before = p, p = next;
      }
    }
  }
  *rules = r;
  r = NULL;
done:
  fs_release(ctx, r);
  return status;
}

typedef struct cell {
  double a, b, size; /* [a, a + size] x [b, b + size] */
  int32_t depth;
} cell;

typedef struct pass {
  const fs_surface *surface;
  int32_t patch, n;
  const fs_rules *rules;
  const double *tolerance;
  const fs_integrand_kernels *kernels;
} pass;

enum { MAX_POINTS = FS_MAX_PATCH_NODES * FS_MAX_PATCH_NODES };

/* A cell at its nodes: parameters of columns and rows, what is integrated, and the weights of its domain. */
typedef struct nodes {
  double a[FS_MAX_PATCH_NODES], b[FS_MAX_PATCH_NODES], scale[FS_MAX_PATCH_NODES];
  double at[FS_AT_N * MAX_POINTS];
} nodes;

/* Keeps samples and extremes of the first pass. */
typedef struct collector {
  fs_patch_shape *shape;
  fs_sample *sample;
  int32_t first, stride, n_samples;
} collector;

static bool is_triangle(const pass *p) { return p->surface->patch[p->patch].n_sides == 3; }

static void evaluate(const pass *p, const cell *c, nodes *at) {
  const int32_t n = p->n, n_points = n * n;
  double jets[3 * FS_JET_SIZE * MAX_POINTS];
  for (int32_t i = 0; i < n; i++) {
    at->a[i] = c->a + c->size * p->rules->node[n][i];
    at->b[i] = c->b + c->size * p->rules->node[n][i];
    at->scale[i] = c->size * c->size * (is_triangle(p) ? 1 - at->a[i] : 1);
  }
  if (is_triangle(p)) {
    double u[MAX_POINTS], v[MAX_POINTS];
    for (int32_t q = 0; q < n_points; q++) u[q] = at->a[q % n], v[q] = at->b[q / n] * (1 - u[q]);
    fs_surface_evaluate_points(p->surface, p->patch, 3, (size_t)n_points, u, v, jets);
  } else {
    fs_surface_evaluate_grid(p->surface, p->patch, n, at->a, at->b, jets);
  }
  p->kernels->at_points((size_t)n_points, jets, at->at);
}

static fs_found found_at(const pass *p, const nodes *at, int32_t q, double value) {
  double u = at->a[q % p->n], v = at->b[q / p->n];
  return (fs_found){value, u, is_triangle(p) ? v * (1 - u) : v};
}

static void collect(const pass *p, const nodes *at, collector *c) {
  static const int8_t row[FS_N_EXTREMES] = {[FS_MOST_H] = FS_AT_H,
                                            [FS_LEAST_H] = FS_AT_H,
                                            [FS_MOST_K] = FS_AT_K,
                                            [FS_LEAST_K] = FS_AT_K,
                                            [FS_MOST_GRADIENT] = FS_AT_GRADIENT,
                                            [FS_LEAST_GRADIENT] = FS_AT_GRADIENT,
                                            [FS_MOST_PRINCIPAL] = FS_AT_MAXIMUM,
                                            [FS_LEAST_PRINCIPAL] = FS_AT_MINIMUM,
                                            [FS_LEAST_AREA] = FS_AT_AREA};
  const int32_t n = p->n, n_points = n * n;
  const double *weight = p->rules->weight[n];
  for (int e = 0; e < FS_N_EXTREMES; e++) {
    const double *value = at->at + (size_t)row[e] * (size_t)n_points;
    double best = NAN;
    int32_t where = 0;
    for (int32_t q = 0; q < n_points; q++)
      if (fs_extreme_is_better((fs_extreme)e, value[q], best)) best = value[q], where = q;
    if (isfinite(best)) c->shape->found[e] = found_at(p, at, where, best);
  }
  for (int32_t q = c->first; q < n_points; q += c->stride) {
    const double *value = at->at + q;
    double gradient = value[FS_AT_GRADIENT * n_points];
    if (!isfinite(gradient)) continue;
    c->sample[c->n_samples++] =
        (fs_sample){value[FS_AT_H * n_points], value[FS_AT_K * n_points], gradient,
                    weight[q % n] * weight[q / n] * value[FS_AT_AREA * n_points] * at->scale[q % n]};
  }
}

/* Estimated error of integral k over the cell. */
static double estimate(const pass *p, const fs_cell_sums *s, int k) {
  double largest = 0;
  for (int top = 0; top < 2; top++) {
    const double *w = p->rules->legendre[p->n][top];
    double a = 0, b = 0;
    for (int32_t i = 0; i < p->n; i++) a += w[i] * s->by_a[k][i], b += w[i] * s->by_b[k][i];
    largest = fmax(largest, fmax(fabs(a), fabs(b)));
  }
  return s->size[k] > 0 ? largest / s->size[k] * largest : 0;
}

/* What errors of a patch are compared with: its integrals, but no less than what a curvature of a part of its largest, or
   of the inverse of 1e6 times its size, would give: else spheres and planes would be cut for their rounding errors. */
static void find_scales(const pass *p, const fs_patch_shape *shape, const fs_cell_sums *s,
                        double scale[FS_N_INTEGRALS]) {
  double area = s->size[FS_AREA], k = 1e-6 / sqrt(area);
  k = fmax(k, fmax(fabs(shape->found[FS_MOST_PRINCIPAL].value), fabs(shape->found[FS_LEAST_PRINCIPAL].value)));
  for (int i = 0; i < FS_N_INTEGRALS; i++) scale[i] = s->size[i];
  scale[FS_WILLMORE] = fmax(scale[FS_WILLMORE], 1e-6 * k * k * area);
  scale[FS_S] = fmax(scale[FS_S], 1e-6 * k * k * k * k * area);
  for (int i = 0; i < FS_N_INTEGRALS; i++) scale[i] *= p->tolerance[i];
}

void fs_patch_measure(const fs_surface *surface, int32_t patch, const fs_rules *rules, const double *tolerance,
                      int32_t first, int32_t stride, fs_patch_shape *shape, fs_sample *sample, int32_t *n_samples) {
  const pass p = {surface, patch,     fs_patch_nodes(&surface->patch[patch]),
                  rules,   tolerance, fs_integrand_kernels_best()};
  collector c = {.shape = shape, .sample = sample, .first = first, .stride = stride};
  cell stack[3 * MAX_DEPTH + 4];
  nodes store, *values = &store;
  int32_t n = 0, n_cells = 0;
  double allowed[FS_N_INTEGRALS] = {0};
  /* where second derivatives have no single value at corners, |grad H|^2 is not integrable there: cells bring nothing */
  const int n_finite = fs_patch_kinds[surface->patch[patch].kind].corner_order < 2 ? FS_S : FS_N_INTEGRALS;
  *shape = (fs_patch_shape){0};
  for (int e = 0; e < FS_N_EXTREMES; e++) shape->found[e].value = NAN;
  stack[n++] = (cell){0, 0, 1, 0};
  while (n > 0) {
    cell at = stack[--n];
    fs_cell_sums s;
    double error[FS_N_INTEGRALS];
    bool is_fine = true;
    evaluate(&p, &at, values);
    p.kernels->add_up(p.n, p.rules->weight[p.n], values->scale, values->at, &s);
    if (at.depth == 0) collect(&p, values, &c);
    if (at.depth == 0) find_scales(&p, shape, &s, allowed);
    for (int k = 0; k < FS_N_INTEGRALS; k++) {
      error[k] = estimate(&p, &s, k);
      if (k < n_finite) is_fine = is_fine && error[k] <= allowed[k] * at.size;
    }
    if (is_fine || at.depth == MAX_DEPTH || ++n_cells > MAX_CELLS) {
      for (int k = 0; k < FS_N_INTEGRALS; k++) shape->integral[k] += s.integral[k], shape->error[k] += error[k];
      continue;
    }
    for (int child = 0; child < 4; child++)
      stack[n++] =
          (cell){at.a + 0.5 * at.size * (child % 2), at.b + 0.5 * at.size * (child / 2), 0.5 * at.size, at.depth + 1};
  }
  *n_samples = c.n_samples;
}
