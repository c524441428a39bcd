/* SPDX-License-Identifier: MIT */
/* Single role: the largest distance of two points of a surface.

   It is the largest width over all directions. Points of a grid in every patch are searched along fixed directions; from the
   best pairs the direction of the pair is taken in turn until it stays, which makes the distance grow. Last both points move
   in their patches, one after the other, by compass searches. */
#include "analyse/analyse.h"
#include "math/vec3.h"

enum { N_DIRECTIONS = 64, N_PAIRS = 4, MAX_TURNS = 20, MAX_ROUNDS = 40 };
static const double golden_angle = 2.399963229728653, last_step = 1e-9, least_gain = 1e-13;

typedef struct points {
  const fs_surface *surface;
  int32_t per_side; /* points per side and direction of a patch */
  int32_t n;
  fs_vec3 *point; /* [n] per_side^2 for each patch */
} points;

typedef struct pair {
  double distance;
  int32_t end[2]; /* points */
} pair;

static fs_place place_of(const points *p, int32_t i) {
  int32_t m = p->per_side, patch = i / (m * m), k = i % (m * m);
  double u = (double)(k % m) / (m - 1), v = (double)(k / m) / (m - 1);
  if (p->surface->patch[patch].n_sides == 3) v *= 1 - u;
  return (fs_place){patch, u, v};
}

static fs_status make_points(fs_context *ctx, points *p) {
  const int32_t n_patches = p->surface->n_patches;
  fs_vec3 x[FS_JET_SIZE];
  fs_status status = FS_OK;
  p->per_side = n_patches <= 1000 ? 9 : n_patches <= 20000 ? 5 : 2;
  p->n = n_patches * p->per_side * p->per_side;
  FS_ALLOC(ctx, p->point, p->n);
  for (int32_t i = 0; i < p->n; i++) {
    fs_place at = place_of(p, i);
    fs_surface_evaluate(p->surface, at.patch, at.u, at.v, x);
    p->point[i] = x[FS_D];
  }
done:
  return status;
}

static pair widest(const points *p, fs_vec3 direction) {
  double low = INFINITY, high = -INFINITY;
  pair found = {0, {0, 0}};
  for (int32_t i = 0; i < p->n; i++) {
    double d = fs_vec3_dot(direction, p->point[i]);
    if (d < low) low = d, found.end[0] = i;
    if (d > high) high = d, found.end[1] = i;
  }
  found.distance = fs_vec3_distance(p->point[found.end[0]], p->point[found.end[1]]);
  return found;
}

static pair turn(const points *p, pair best) {
  for (int32_t k = 0; k < MAX_TURNS; k++) {
    pair next = widest(p, fs_vec3_sub(p->point[best.end[1]], p->point[best.end[0]]));
    if (!(next.distance > best.distance)) break;
    best = next;
  }
  return best;
}

/* Moves a place within its patch away from a point. */
static double move_away(const fs_surface *surface, fs_vec3 from, fs_place *at) {
  fs_vec3 x[FS_JET_SIZE];
  double best, before, step = 0.125;
  fs_surface_evaluate(surface, at->patch, at->u, at->v, x);
  best = fs_vec3_distance(from, x[FS_D]);
  while (step > last_step) {
    fs_place next = *at;
    before = best;
    for (int k = 0; k < 9; k++) {
      double u = fmin(fmax(at->u + step * (k % 3 - 1), 0), 1);
      double v = fmin(fmax(at->v + step * (k / 3 - 1), 0), surface->patch[at->patch].n_sides == 3 ? 1 - u : 1), d;
      fs_surface_evaluate(surface, at->patch, u, v, x);
      d = fs_vec3_distance(from, x[FS_D]);
      if (d > best) best = d, next = (fs_place){at->patch, u, v};
    }
    if (!(best > before * (1 + least_gain))) step *= 0.5;
    *at = next;
  }
  return best;
}

static double move_both(const fs_surface *surface, fs_place end[2]) {
  double distance = 0;
  for (int32_t round = 0; round < MAX_ROUNDS; round++) {
    fs_vec3 x[FS_JET_SIZE];
    const fs_place fixed = end[round % 2];
    double moved;
    fs_surface_evaluate(surface, fixed.patch, fixed.u, fixed.v, x);
    moved = move_away(surface, x[FS_D], &end[1 - round % 2]);
    if (round > 1 && !(moved > distance * (1 + least_gain))) break;
    distance = moved;
  }
  return distance;
}

fs_status fs_surface_diameter(fs_context *ctx, const fs_surface *surface, double *diameter, fs_place end[2]) {
  points p = {.surface = surface};
  pair best[N_PAIRS] = {{0, {0, 0}}};
  fs_status status = FS_OK;
  *diameter = 0;
  FS_TRY(make_points(ctx, &p));
  for (int32_t k = 0; k < N_DIRECTIONS && p.n > 0; k++) {
    double z = (k + 0.5) / N_DIRECTIONS, r = sqrt(1 - z * z), angle = golden_angle * k;
    pair found = widest(&p, (fs_vec3){r * cos(angle), r * sin(angle), z});
    for (int i = 0; i < N_PAIRS; i++)
      if (found.distance > best[i].distance) {
        pair other = best[i];
        best[i] = found;
        found = other;
      }
  }
  for (int i = 0; i < N_PAIRS; i++) {
    if (!(best[i].distance > 0)) continue;
    pair wide = turn(&p, best[i]);
    fs_place at[2] = {place_of(&p, wide.end[0]), place_of(&p, wide.end[1])};
    double distance = move_both(surface, at);
    if (distance > *diameter) *diameter = distance, end[0] = at[0], end[1] = at[1];
  }
done:
  fs_release(ctx, p.point);
  return status;
}
