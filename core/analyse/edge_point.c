/* SPDX-License-Identifier: MIT */
/* Single role: points of sides and of edges. Where the parameters of two sides say nothing about each other, the second
   point is the closest one to the first: |q(t) - p|^2 is minimised by Newton's method within the stretch, from the best of
   equidistant points where the first guess is not close already. */
#include "analyse/analyse.h"
#include "math/vec3.h"

fs_place fs_side_place(const fs_surface *surface, int32_t patch, int32_t side, double t) {
  fs_place place = {.patch = patch};
  fs_side_parameters(surface->patch[patch].n_sides, side, t, &place.u, &place.v);
  return place;
}

void fs_side_evaluate(const fs_surface *surface, int32_t patch, int32_t side, double t, fs_vec3 x[FS_JET_SIZE]) {
  fs_place place = fs_side_place(surface, patch, side, t);
  fs_surface_evaluate(surface, patch, place.u, place.v, x);
}

/* First and second derivative along a side, which is a straight line of the parameters. */
static void derivatives_along(const fs_surface *surface, int32_t patch, int32_t side, const fs_vec3 *x, fs_vec3 *first,
                              fs_vec3 *second) {
  fs_place a = fs_side_place(surface, patch, side, 0), b = fs_side_place(surface, patch, side, 1);
  double du = b.u - a.u, dv = b.v - a.v;
  *first = fs_vec3_add_scaled(fs_vec3_scale(x[FS_DU], du), x[FS_DV], dv);
  *second = fs_vec3_add_scaled(fs_vec3_add_scaled(fs_vec3_scale(x[FS_DUU], du * du), x[FS_DUV], 2 * du * dv), x[FS_DVV],
                               dv * dv);
}

static double clamp(double t, double from, double to) {
  double low = fmin(from, to), high = fmax(from, to);
  return fmin(fmax(t, low), high);
}

/* Newton's method with halved steps where the distance grows. speed: of the side at the end, length per parameter. */
static double approach(const fs_surface *surface, int32_t patch, int32_t side, double from, double to, fs_vec3 point,
                       double *t, double *speed) {
  enum { MAX_STEPS = 50 };
  fs_vec3 x[FS_JET_SIZE], first, second;
  double best;
  fs_side_evaluate(surface, patch, side, *t, x);
  best = fs_vec3_distance(x[FS_D], point);
  *speed = 0;
  for (int32_t step = 0; step < MAX_STEPS && best > 0; step++) {
    fs_vec3 gap = fs_vec3_sub(x[FS_D], point), y[FS_JET_SIZE];
    double slope, bend, move, next, distance = INFINITY;
    derivatives_along(surface, patch, side, x, &first, &second);
    *speed = fs_vec3_length(first);
    slope = fs_vec3_dot(gap, first);
    bend = fs_vec3_dot(first, first) + fs_vec3_dot(gap, second);
    if (!(bend > 0)) bend = fs_vec3_dot(first, first);
    if (!(bend > 0)) break;
    move = -slope / bend;
    for (int32_t halving = 0; halving < 8; halving++, move *= 0.5) {
      next = clamp(*t + move, from, to);
      fs_side_evaluate(surface, patch, side, next, y);
      distance = fs_vec3_distance(y[FS_D], point);
      if (distance < best) break;
    }
    if (!(distance < best)) break;
    move = fabs(next - *t);
    *t = next;
    best = distance;
    for (int k = 0; k < FS_JET_SIZE; k++) x[k] = y[k];
    if (move < 1e-16) break;
  }
  return best;
}

double fs_side_closest(const fs_surface *surface, int32_t patch, int32_t side, double from, double to, fs_vec3 point,
                       double *t) {
  enum { N_STARTS = 16 };
  fs_vec3 x[FS_JET_SIZE];
  double start = *t, best, speed, distance = INFINITY;
  *t = clamp(*t, from, to);
  best = approach(surface, patch, side, from, to, point, t, &speed);
  if (best <= 1e-4 * speed * fabs(to - from)) return best;
  /* A poor start may have ended elsewhere. */
  for (int32_t k = 0; k <= N_STARTS; k++) {
    double s = from + (to - from) * k / N_STARTS, d;
    fs_side_evaluate(surface, patch, side, s, x);
    d = fs_vec3_distance(x[FS_D], point);
    if (d < distance) distance = d, start = s;
  }
  if (distance < best) {
    double other = start, d = approach(surface, patch, side, from, to, point, &other, &speed);
    if (d < best) best = d, *t = other;
  }
  return best;
}

void fs_edge_evaluate(const fs_surface *surface, const fs_edge *edge, double t, fs_edge_point *point) {
  for (int k = 0; k < 2; k++) {
    double s = t < 1 ? edge->begin[k] + t * (edge->end[k] - edge->begin[k]) : edge->end[k];
    if (k == 1 && edge->patch[1] == FS_NONE) return;
    if (k == 1 && !edge->is_given)
      fs_side_closest(surface, edge->patch[1], edge->side[1], edge->begin[1], edge->end[1], point->jet[0][FS_D], &s);
    point->place[k] = fs_side_place(surface, edge->patch[k], edge->side[k], s);
    fs_surface_evaluate(surface, edge->patch[k], point->place[k].u, point->place[k].v, point->jet[k]);
  }
}
