/* SPDX-License-Identifier: MIT */
/* Single role: integrals of a patch by Gauss-Legendre quadrature, halved where it is not fine enough yet.

   With n nodes per direction the rule is exact for degree 2 n - 1, and for smooth integrands its error falls with n as the
   square of their Legendre coefficients of degree n does. Those of degree n - 1 and n - 2 are sums over the same nodes,
     c_k = (2 k + 1) sum_i w_i P_k(2 x_i - 1) g_i,
   with the integrand g summed over the other direction; the square of their part of c_0 estimates the relative error. Where it
   is too large for one of the integrals, the domain is cut in four. Patches of three sides are the image of the square
   under (a, b) -> (a, b (1 - a)). */
#include "analyse/analyse.h"
#include "math/diffgeo.h"
#include "math/quadrature.h"
#include "math/vec3.h"

enum { MAX_DEPTH = 7, MAX_CELLS = 400 };

int32_t fs_patch_nodes(const fs_patch *patch) {
  int32_t degree = patch->degree_u > patch->degree_v ? patch->degree_u : patch->degree_v;
  int32_t n = (3 * degree + 1) / 2; /* p . (p_u x p_v) has degree 3 degree - 1: exact */
  return n < FS_MIN_PATCH_NODES ? FS_MIN_PATCH_NODES : n > FS_MAX_PATCH_NODES ? FS_MAX_PATCH_NODES : n;
}

fs_status fs_rules_create(fs_context *ctx, fs_rules **rules) {
  fs_rules *r = NULL;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, r, 1);
  for (int32_t n = FS_MIN_PATCH_NODES; n <= FS_MAX_PATCH_NODES; n++) {
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
} pass;

/* The integrands by u and v; where there is no normal, only position and area count. */
static void evaluate(const pass *p, double u, double v, double f[FS_N_INTEGRALS], fs_point_values *values) {
  fs_vec3 x[FS_JET_SIZE];
  double area, H, gradient;
  fs_surface_evaluate(p->surface, p->patch, u, v, x);
  fs_point_evaluate(x, values);
  area = values->value[FS_LEAST_AREA];
  H = values->value[FS_MOST_H];
  gradient = values->value[FS_MOST_GRADIENT];
  f[FS_AREA] = area;
  f[FS_VOLUME] = fs_vec3_dot(x[FS_D], fs_vec3_cross(x[FS_DU], x[FS_DV])) / 3;
  f[FS_WILLMORE] = isfinite(H) ? H * H * area : 0;
  f[FS_S] = isfinite(gradient) ? gradient * gradient * area : 0;
}

/* Sums f and its marginals over a cell; keeps samples and extremes in the first pass. */
typedef struct sums {
  double integral[FS_N_INTEGRALS], size[FS_N_INTEGRALS]; /* of f, of |f| */
  double by_a[FS_N_INTEGRALS][FS_MAX_PATCH_NODES], by_b[FS_N_INTEGRALS][FS_MAX_PATCH_NODES];
} sums;

typedef struct collector {
  fs_patch_shape *shape;
  fs_sample *sample;
  int32_t stride, n_seen, n_samples;
} collector;

static void collect(collector *c, double u, double v, double area, const fs_point_values *values) {
  const double *value = values->value;
  for (int e = 0; e < FS_N_EXTREMES; e++)
    if (fs_extreme_is_better((fs_extreme)e, value[e], c->shape->found[e].value))
      c->shape->found[e] = (fs_found){value[e], u, v};
  if (c->stride > 0 && c->n_seen++ % c->stride == 0 && isfinite(value[FS_MOST_GRADIENT]))
    c->sample[c->n_samples++] = (fs_sample){value[FS_MOST_H], value[FS_MOST_K], value[FS_MOST_GRADIENT], area};
}

static void sum_cell(const pass *p, const cell *at, sums *s, collector *c) {
  const bool is_triangle = p->surface->patch[p->patch].n_sides == 3;
  const double *node = p->rules->node[p->n], *weight = p->rules->weight[p->n];
  *s = (sums){0};
  for (int32_t j = 0; j < p->n; j++)
    for (int32_t i = 0; i < p->n; i++) {
      double a = at->a + at->size * node[i], b = at->b + at->size * node[j], f[FS_N_INTEGRALS];
      double u = a, v = is_triangle ? b * (1 - a) : b, jacobian = at->size * at->size * (is_triangle ? 1 - a : 1);
      fs_point_values values;
      evaluate(p, u, v, f, &values);
      for (int k = 0; k < FS_N_INTEGRALS; k++) {
        f[k] *= jacobian;
        s->integral[k] += weight[i] * weight[j] * f[k];
        s->size[k] += weight[i] * weight[j] * fabs(f[k]);
        s->by_a[k][i] += weight[j] * f[k];
        s->by_b[k][j] += weight[i] * f[k];
      }
      if (c != NULL) collect(c, u, v, weight[i] * weight[j] * f[FS_AREA], &values);
    }
}

/* Estimated error of integral k over the cell. */
static double estimate(const pass *p, const sums *s, int k) {
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
static void find_scales(const pass *p, const fs_patch_shape *shape, const sums *s, double scale[FS_N_INTEGRALS]) {
  double area = s->size[FS_AREA], k = 1e-6 / sqrt(area);
  k = fmax(k, fmax(fabs(shape->found[FS_MOST_PRINCIPAL].value), fabs(shape->found[FS_LEAST_PRINCIPAL].value)));
  for (int i = 0; i < FS_N_INTEGRALS; i++) scale[i] = s->size[i];
  scale[FS_WILLMORE] = fmax(scale[FS_WILLMORE], 1e-6 * k * k * area);
  scale[FS_S] = fmax(scale[FS_S], 1e-6 * k * k * k * k * area);
  for (int i = 0; i < FS_N_INTEGRALS; i++) scale[i] *= p->tolerance[i];
}

void fs_patch_measure(const fs_surface *surface, int32_t patch, const fs_rules *rules, const double *tolerance,
                      int32_t stride, fs_patch_shape *shape, fs_sample *sample, int32_t *n_samples) {
  const pass p = {surface, patch, fs_patch_nodes(&surface->patch[patch]), rules, tolerance};
  collector c = {.shape = shape, .sample = sample, .stride = stride};
  cell stack[3 * MAX_DEPTH + 4];
  int32_t n = 0, n_cells = 0;
  double allowed[FS_N_INTEGRALS] = {0};
  *shape = (fs_patch_shape){0};
  for (int e = 0; e < FS_N_EXTREMES; e++) shape->found[e].value = NAN;
  stack[n++] = (cell){0, 0, 1, 0};
  while (n > 0) {
    cell at = stack[--n];
    sums s;
    double error[FS_N_INTEGRALS];
    bool is_fine = true;
    sum_cell(&p, &at, &s, at.depth == 0 ? &c : NULL);
    if (at.depth == 0) find_scales(&p, shape, &s, allowed);
    for (int k = 0; k < FS_N_INTEGRALS; k++) {
      error[k] = estimate(&p, &s, k);
      is_fine = is_fine && error[k] <= allowed[k] * at.size;
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
