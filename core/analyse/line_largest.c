/* SPDX-License-Identifier: MIT */
/* Single role: the largest jumps along a line, found by samples that are added where they may change the answer.

   Between neighbouring samples a smooth function f exceeds both by at most max |f''| h^2 / 8. The divided differences of
   second order at the two samples estimate f'' / 2; four times what they allow is the doubt about an interval of length h:
   |f[., ., .]| h^2. Intervals whose larger end plus doubt exceeds the largest value found so far by more than the wanted part
   are halved. Then the best sample and its neighbours are a bracket, in which the maximum is followed by parabolas with
   golden sections as a safeguard [Brent 1973, ch. 5]. */
#include "analyse/analyse.h"
#include "math/vec3.h"

#include <string.h>

enum { N_START = 9, MOST_START = 65, MAX_SAMPLES = 400 };

static const double least_interval = 1e-7;

typedef struct sample {
  double t, jump[FS_N_JUMPS]; /* NAN: none */
} sample;

typedef struct search {
  const fs_line *line;
  fs_line_jumps *result;
  double largest_coordinate, shortest_tangent;
  int32_t n;
  sample at[MAX_SAMPLES]; /* ascending t */
} search;

static double tangent_length(const fs_vec3 *x, const fs_vec3 *y) {
  return fmin(fmin(fs_vec3_length(x[FS_DU]), fs_vec3_length(x[FS_DV])),
              fmin(fs_vec3_length(y[FS_DU]), fs_vec3_length(y[FS_DV])));
}

static void evaluate(search *s, double t, sample *new) {
  fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
  double curvature, coordinate;
  fs_line_jumps *r = s->result;
  s->line->evaluate(s->line->user, t, x, y);
  new->t = t;
  fs_jumps_between(x, y, s->line->is_flipped, new->jump, &curvature);
  coordinate = fmax(fabs(x[FS_D].x), fmax(fabs(x[FS_D].y), fabs(x[FS_D].z)));
  if (coordinate > s->largest_coordinate) s->largest_coordinate = coordinate;
  if (!isnan(new->jump[FS_JUMP_NORMAL])) s->shortest_tangent = fmin(s->shortest_tangent, tangent_length(x, y));
  if (curvature > r->largest_curvature) r->largest_curvature = curvature;
  r->n_samples++;
  r->n_irregular += isnan(new->jump[FS_JUMP_NORMAL]);
  for (int k = 0; k < FS_N_JUMPS; k++)
    if (new->jump[k] > r->value[k] || (isnan(r->value[k]) && !isnan(new->jump[k])))
      r->value[k] = new->jump[k], r->t[k] = t;
}

/* What rounding errors alone may make of a jump: coordinates of size P carry errors of some 1e-16 P, derivatives of order m
   errors of some 1e-14 P, and with tangents of length h these count as 1 / h^m. */
static double floor_of(const search *s, int k) {
  double curvature = s->result->largest_curvature, P = s->largest_coordinate, h = s->shortest_tangent;
  switch (k) {
  case FS_JUMP_POSITION:
    return 1e-14 * P;
  case FS_JUMP_NORMAL:
    return 1e-13 + 1e-14 * P / h;
  case FS_JUMP_CURVATURE:
    return 1e-12 * curvature + 1e-13 * P / (h * h);
  default:
    return 1e-11 * curvature * curvature + 1e-12 * P / (h * h * h);
  }
}

/* Divided difference of second order around sample i; 0 where samples are missing. */
static double second_difference(const search *s, int32_t i, int k) {
  const sample *a, *b, *c;
  double value;
  if (i < 1 || i + 1 >= s->n) return 0;
  a = &s->at[i - 1], b = &s->at[i], c = &s->at[i + 1];
  value = ((c->jump[k] - b->jump[k]) / (c->t - b->t) - (b->jump[k] - a->jump[k]) / (b->t - a->t)) / (c->t - a->t);
  return isfinite(value) ? fabs(value) : 0;
}

/* Whether the interval after sample i may hold a value that is larger than all by more than a part precision. */
static bool is_open(const search *s, int32_t i, double precision) {
  const sample *a = &s->at[i], *b = &s->at[i + 1];
  double h = b->t - a->t;
  if (h < least_interval) return false;
  for (int k = 0; k < FS_N_JUMPS; k++) {
    double most = s->result->value[k], ends = fmax(a->jump[k], b->jump[k]);
    if (!(most > floor_of(s, k)) || isnan(ends)) continue;
    double doubt = fmax(second_difference(s, i, k), second_difference(s, i + 1, k)) * h * h;
    if (ends + doubt > most * (1 + precision)) return true;
  }
  return false;
}

/* One pass over all intervals, from the end so that numbers before stay. Returns whether some were halved. */
static bool halve_open(search *s, double precision) {
  bool is_open_at[MAX_SAMPLES] = {false}, is_any = false;
  for (int32_t i = 0; i + 1 < s->n; i++) is_open_at[i] = is_open(s, i, precision);
  for (int32_t i = s->n - 2; i >= 0 && s->n < MAX_SAMPLES; i--) {
    if (!is_open_at[i]) continue;
    sample new;
    evaluate(s, 0.5 * (s->at[i].t + s->at[i + 1].t), &new);
    memmove(&s->at[i + 2], &s->at[i + 1], (size_t)(s->n - i - 1) * sizeof *s->at);
    s->at[i + 1] = new;
    s->n++;
    is_any = true;
  }
  return is_any;
}

/* Maximum of jump k in [a, b] around the best sample m, by Brent's method. evaluate() keeps the best. */
static void follow(search *s, int k, double a, double m, double b, double value) {
  enum { MAX_STEPS = 60 };
  const double golden = 0.3819660112501051, least = 1e-9;
  double x = m, w = m, v = m, fx = value, fw = value, fv = value, step = 0, before = 0;
  for (int32_t i = 0; i < MAX_STEPS && b - a > 4 * least; i++) {
    double middle = 0.5 * (a + b), t, f;
    bool is_golden = true;
    sample new;
    if (fabs(before) > least) { /* the parabola through the three best */
      double r = (x - w) * (fx - fv), q = (x - v) * (fx - fw), p = (x - v) * q - (x - w) * r;
      q = 2 * (q - r);
      if (q > 0) p = -p;
      q = fabs(q);
      if (fabs(p) < fabs(0.5 * q * before) && p > q * (a - x) && p < q * (b - x)) {
        before = step;
        step = p / q;
        is_golden = false;
      }
    }
    if (is_golden) {
      before = x < middle ? b - x : a - x;
      step = golden * before;
    }
    t = x + (fabs(step) >= least ? step : step > 0 ? least : -least);
    if (t < a || t > b) break;
    evaluate(s, t, &new);
    f = new.jump[k];
    if (isnan(f)) return;
    if (f >= fx) {
      if (t < x)
        b = x;
      else
        a = x;
      v = w, fv = fw, w = x, fw = fx, x = t, fx = f;
    } else {
      if (t < x)
        a = t;
      else
        b = t;
      if (f >= fw || w == x)
        v = w, fv = fw, w = t, fw = f;
      else if (f >= fv || v == x || v == w)
        v = t, fv = f;
    }
    if (fabs(x - 0.5 * (a + b)) <= 2 * least - 0.5 * (b - a)) break;
  }
}

/* The maximum near the best of the samples, for every kind of jump. */
static void follow_all(search *s) {
  for (int k = 0; k < FS_N_JUMPS; k++) {
    int32_t best = FS_NONE;
    for (int32_t i = 0; i < s->n; i++)
      if (!isnan(s->at[i].jump[k]) && (best == FS_NONE || s->at[i].jump[k] > s->at[best].jump[k])) best = i;
    if (best == FS_NONE || !(s->at[best].jump[k] > floor_of(s, k))) continue;
    follow(s, k, s->at[best > 0 ? best - 1 : 0].t, s->at[best].t, s->at[best + 1 < s->n ? best + 1 : best].t,
           s->at[best].jump[k]);
  }
}

void fs_line_largest(const fs_line *line, double precision, fs_line_jumps *jumps) {
  fs_line_jumps result = {{NAN, NAN, NAN, NAN}, {0, 0, 0, 0}, 0, 0, 0};
  search s = {.line = line, .result = &result, .shortest_tangent = INFINITY};
  int32_t n = line->n_start == 0 ? N_START : line->n_start;
  n = n < 3 ? 3 : n > MOST_START ? MOST_START : n;
  for (int32_t i = 0; i < n; i++) evaluate(&s, (double)i / (n - 1), &s.at[s.n++]);
  while (halve_open(&s, precision)) continue;
  if (precision <= 1e-3) follow_all(&s);
  *jumps = result;
}
