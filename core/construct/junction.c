/* SPDX-License-Identifier: MIT */
/* Single role: the columns of a patch that continues an auxiliary patch (equations in junction.h), in Bernstein form.

   With R_j the columns of P, of degree m by v:  R_1 = R_0 + P_v / m,  R_2 = 2 R_1 - R_0 + P_vv / (m (m - 1)).
   Along the edge of the auxiliary patch, of degree (n, k) with columns p_j:
     p_t = k (p_1 - p_0),  p_tt = k (k - 1) (p_2 - 2 p_1 + p_0),  p_s, p_ss, p_st: derivatives of p_0 and p_t.
   [Kiciak 2013 and docs/splines.md; the terms of P_vv are those of the chain rule.] */
#include "construct/polynomial.h"
#include "math/bernstein.h"
#include "math/vec3.h"

#include <fairsurf/construct_junction.h>
#include "base/base.h"

#include <string.h>

enum { MAX = FS_MAX_DEGREE, N_SAMPLES = 65 };

static const char *const name[FS_N_JUNCTION_FUNCTIONS] = {"beta1", "gamma1", "beta2", "gamma2"};

/* A curve along the edge: [degree + 1][3]. */
typedef struct curve {
  int32_t degree;
  double c[3 * (MAX + 1)];
} curve;

typedef struct edge {
  curve p, ps, pss, pt, pst, ptt;
} edge;

static void differentiate(const curve *from, curve *to) {
  fs_bernstein_differentiate(from->degree, 3, from->c, to->c);
  to->degree = from->degree > 0 ? from->degree - 1 : 0;
}

static void set_edge(const fs_bezier_patch *aux, edge *e) {
  int32_t n = aux->degree_u, m = aux->degree_v;
  const double *row = &aux->point[0].x;
  e->p.degree = e->pt.degree = e->ptt.degree = n;
  for (int32_t i = 0; i < 3 * (n + 1); i++) {
    const double p0 = row[i], p1 = row[i + 3 * (n + 1)], p2 = m > 1 ? row[i + 6 * (n + 1)] : 0;
    e->p.c[i] = p0;
    e->pt.c[i] = m * (p1 - p0);
    e->ptt.c[i] = m > 1 ? m * (m - 1) * (p2 - 2 * p1 + p0) : 0;
  }
  differentiate(&e->p, &e->ps);
  differentiate(&e->ps, &e->pss);
  differentiate(&e->pt, &e->pst);
}

/* A term of the equations: product of up to two functions with a derivative of p, times factor. */
typedef struct term {
  int8_t first, second; /* functions, second -1: none */
  int8_t derivative;    /* 0: p_s, 1: p_t, 2: p_ss, 3: p_st, 4: p_tt */
  int8_t factor;
} term;
static const term first_order[] = {{FS_BETA_1, -1, 0, 1}, {FS_GAMMA_1, -1, 1, 1}};
static const term second_order[] = {{FS_BETA_2, -1, 0, 1},
                                    {FS_GAMMA_2, -1, 1, 1},
                                    {FS_BETA_1, FS_BETA_1, 2, 1},
                                    {FS_BETA_1, FS_GAMMA_1, 3, 2},
                                    {FS_GAMMA_1, FS_GAMMA_1, 4, 1}};

/* Degree of a term by u; -1 where it vanishes. */
static int32_t term_degree(const fs_bezier_patch *aux, const fs_junction *j, const term *t) {
  static const int8_t loss[5] = {1, 0, 2, 1, 0};
  int32_t degree = aux->degree_u - loss[t->derivative];
  if (j->function[t->first] == NULL || (t->second >= 0 && j->function[t->second] == NULL)) return -1;
  if (degree < 0 || (t->derivative == 4 && aux->degree_v < 2)) return -1;
  return degree + j->degree[t->first] + (t->second >= 0 ? j->degree[t->second] : 0);
}

int32_t fs_junction_degree(const fs_bezier_patch *aux, const fs_junction *junction, int32_t order) {
  int32_t degree = aux->degree_u;
  for (size_t i = 0; i < sizeof first_order / sizeof *first_order; i++) {
    int32_t d = term_degree(aux, junction, &first_order[i]);
    if (d > degree) degree = d;
  }
  for (size_t i = 0; i < sizeof second_order / sizeof *second_order && order == 2; i++) {
    int32_t d = term_degree(aux, junction, &second_order[i]);
    if (d > degree) degree = d;
  }
  return degree;
}

/* sum[degree_u + 1][3] += the term, raised to degree_u */
static void add_term(const fs_bezier_patch *aux, const edge *e, const fs_junction *j, const term *t, int32_t degree_u,
                     double *sum) {
  const curve *const derivative[5] = {&e->ps, &e->pt, &e->pss, &e->pst, &e->ptt};
  const curve *d = derivative[t->derivative];
  int32_t degree = term_degree(aux, j, t), scalar_degree = j->degree[t->first];
  double scalar[MAX + 1] = {0}, product[3 * (MAX + 1)] = {0}, raised[3 * (MAX + 1)];
  if (degree < 0) return;
  if (t->second < 0) {
    memcpy(scalar, j->function[t->first], (size_t)(scalar_degree + 1) * sizeof *scalar);
  } else {
    fs_bernstein_add_product(scalar_degree, j->function[t->first], j->degree[t->second], 1, j->function[t->second],
                             scalar);
    scalar_degree += j->degree[t->second];
  }
  fs_bernstein_add_product(scalar_degree, scalar, d->degree, 3, d->c, product);
  fs_bernstein_elevate(degree, 3, product, degree_u, raised);
  for (int32_t i = 0; i < 3 * (degree_u + 1); i++) sum[i] += t->factor * raised[i];
}

/* ---- checks ---- */

static fs_status check_degrees(fs_context *ctx, const fs_bezier_patch *aux, const fs_junction *j, int32_t order,
                               int32_t degree_u, int32_t degree_v) {
  static const char *const derivative[5] = {"p_s", "p_t", "p_ss", "p_st", "p_tt"};
  if (order != 1 && order != 2) return fs_fail(ctx, FS_ERR_ARGUMENT, "a junction has order 1 or 2, not %d", (int)order);
  if (aux->degree_u < 1 || aux->degree_v < 1 || aux->degree_u > MAX || aux->degree_v > MAX)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the auxiliary patch has degree (%d, %d), which is not between 1 and %d",
                   (int)aux->degree_u, (int)aux->degree_v, MAX);
  if (degree_u > MAX || degree_v > MAX || degree_v < order)
    return fs_fail(ctx, FS_ERR_ARGUMENT,
                   "a patch of degree (%d, %d) cannot meet a junction of order %d: v needs %d to %d", (int)degree_u,
                   (int)degree_v, (int)order, (int)order, MAX);
  if (aux->degree_u > degree_u)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the auxiliary patch has degree %d along the edge, the final patch only %d",
                   (int)aux->degree_u, (int)degree_u);
  for (size_t i = 0; i < 2 + (order == 2 ? sizeof second_order / sizeof *second_order : 0); i++) {
    const term *t = i < 2 ? &first_order[i] : &second_order[i - 2];
    int32_t degree = term_degree(aux, j, t);
    if (degree > degree_u)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "%s%s%s %s has degree %d along the edge, the final patch only %d",
                     name[t->first], t->second >= 0 ? " " : "", t->second >= 0 ? name[t->second] : "",
                     derivative[t->derivative], (int)degree, (int)degree_u);
  }
  return FS_OK;
}

static fs_status check_functions(fs_context *ctx, const fs_junction *j) {
  double at = 0;
  for (int f = 0; f < FS_N_JUNCTION_FUNCTIONS; f++) {
    if (j->function[f] == NULL) continue;
    if (j->degree[f] < 0 || j->degree[f] > MAX)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "%s has degree %d, which is not between 0 and %d", name[f],
                     (int)j->degree[f], MAX);
    for (int32_t i = 0; i <= j->degree[f]; i++)
      if (!isfinite(j->function[f][i]))
        return fs_fail(ctx, FS_ERR_ARGUMENT, "coefficient %d of %s is not finite", (int)i, name[f]);
  }
  if (j->function[FS_GAMMA_1] == NULL) return fs_fail(ctx, FS_ERR_ARGUMENT, "gamma1 is missing: it must not vanish");
  if (fs_polynomial_sign(j->degree[FS_GAMMA_1], j->function[FS_GAMMA_1], &at) == 0)
    return fs_fail(ctx, FS_ERR_ARGUMENT,
                   "gamma1 vanishes or changes its sign near u = %.3g: the patch has no width there", at);
  return FS_OK;
}

static fs_vec3 value(const curve *c, double t) {
  double basis[MAX + 1], x[3] = {0, 0, 0};
  fs_bernstein_basis(c->degree, t, 0, basis);
  for (int32_t i = 0; i <= c->degree; i++)
    for (int w = 0; w < 3; w++) x[w] += basis[i] * c->c[3 * i + w];
  return (fs_vec3){x[0], x[1], x[2]};
}

static fs_status check_edge(fs_context *ctx, const edge *e) {
  for (int i = 0; i < N_SAMPLES; i++) {
    double t = (double)i / (N_SAMPLES - 1);
    fs_vec3 s = value(&e->ps, t), v = value(&e->pt, t);
    if (!(fs_vec3_length(fs_vec3_cross(s, v)) > 1e-12 * fs_vec3_length(s) * fs_vec3_length(v)))
      return fs_fail(ctx, FS_ERR_NUMERIC, "the auxiliary patch has no normal at its edge, near u = %.3g", t);
  }
  return FS_OK;
}

fs_status fs_junction_columns(fs_context *ctx, const fs_bezier_patch *aux, const fs_junction *junction, int32_t order,
                              int32_t degree_u, int32_t degree_v, fs_vec3 *column) {
  fs_status status = FS_OK;
  edge e;
  double R[3 * (MAX + 1)], Pv[3 * (MAX + 1)] = {0}, Pvv[3 * (MAX + 1)] = {0};
  FS_TRY(check_functions(ctx, junction));
  FS_TRY(check_degrees(ctx, aux, junction, order, degree_u, degree_v));
  set_edge(aux, &e);
  FS_TRY(check_edge(ctx, &e));
  fs_bernstein_elevate(e.p.degree, 3, e.p.c, degree_u, R);
  for (size_t i = 0; i < sizeof first_order / sizeof *first_order; i++)
    add_term(aux, &e, junction, &first_order[i], degree_u, Pv);
  for (size_t i = 0; i < sizeof second_order / sizeof *second_order && order == 2; i++)
    add_term(aux, &e, junction, &second_order[i], degree_u, Pvv);
  for (int32_t i = 0; i <= degree_u; i++) {
    const fs_vec3 r0 = {R[3 * i], R[3 * i + 1], R[3 * i + 2]};
    const fs_vec3 v = {Pv[3 * i], Pv[3 * i + 1], Pv[3 * i + 2]}, vv = {Pvv[3 * i], Pvv[3 * i + 1], Pvv[3 * i + 2]};
    const fs_vec3 r1 = fs_vec3_add_scaled(r0, v, 1.0 / degree_v);
    column[i] = r0;
    column[i + degree_u + 1] = r1;
    if (order == 2)
      column[i + 2 * (degree_u + 1)] =
          fs_vec3_add_scaled(fs_vec3_sub(fs_vec3_scale(r1, 2), r0), vv, 1.0 / (degree_v * (degree_v - 1)));
  }
done:
  return status;
}
