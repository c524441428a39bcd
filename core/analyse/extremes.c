/* SPDX-License-Identifier: MIT */
/* Single role: extreme values of curvatures within a patch: a compass search, which needs no derivatives of order 4 and
   stays in the domain. Steps are halved where no neighbour is better, so that near a smooth extreme the error of the value is
   of second order in the last step. [Kolda Lewis Torczon 2003] */
#include "analyse/analyse.h"
#include "math/diffgeo.h"
#include "math/vec3.h"

static const double last_step = 1e-7, least_gain = 1e-12;

void fs_point_evaluate(const fs_vec3 x[FS_JET_SIZE], fs_point_values *values) {
  double *value = values->value;
  fs_geometry g;
  fs_principal principal;
  for (int e = 0; e < FS_N_EXTREMES; e++) value[e] = NAN;
  value[FS_LEAST_AREA] = fs_vec3_length(fs_vec3_cross(x[FS_DU], x[FS_DV]));
  if (!fs_geometry_compute(x, &g)) return;
  fs_geometry_principal(&g, &principal);
  value[FS_MOST_H] = value[FS_LEAST_H] = g.H;
  value[FS_MOST_K] = value[FS_LEAST_K] = g.K;
  value[FS_MOST_GRADIENT] = value[FS_LEAST_GRADIENT] = fs_vec3_length(fs_geometry_mean_gradient(x, &g));
  value[FS_MOST_PRINCIPAL] = principal.maximum;
  value[FS_LEAST_PRINCIPAL] = principal.minimum;
}

static bool is_most(fs_extreme e) {
  return e == FS_MOST_H || e == FS_MOST_K || e == FS_MOST_GRADIENT || e == FS_MOST_PRINCIPAL;
}

bool fs_extreme_is_better(fs_extreme e, double a, double b) {
  if (!isfinite(a)) return false;
  return isnan(b) || (is_most(e) ? a > b : a < b);
}

/* Into the domain: a square, or the triangle below its diagonal. */
static void clamp(int32_t n_sides, double *u, double *v) {
  *u = fmin(fmax(*u, 0), 1);
  *v = fmin(fmax(*v, 0), n_sides == 3 ? 1 - *u : 1);
}

void fs_extreme_follow(const fs_surface *surface, int32_t patch, fs_extreme e, double step, double least_area,
                       fs_found *found) {
  static const int way[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}};
  enum { MAX_MOVES = 1000 };
  int32_t n_moves = 0;
  while (step > last_step && n_moves < MAX_MOVES) {
    fs_found best = *found;
    for (int k = 0; k < 8; k++) {
      fs_vec3 x[FS_JET_SIZE];
      fs_point_values values;
      double u = found->u + step * way[k][0], v = found->v + step * way[k][1];
      clamp(surface->patch[patch].n_sides, &u, &v);
      if (u == found->u && v == found->v) continue;
      fs_surface_evaluate(surface, patch, u, v, x);
      fs_point_evaluate(x, &values);
      if (e != FS_LEAST_AREA && !(values.value[FS_LEAST_AREA] >= least_area)) continue;
      if (fs_extreme_is_better(e, values.value[e], best.value)) best = (fs_found){values.value[e], u, v};
    }
    /* gains of the size of rounding errors lead nowhere: many extremes are not single points */
    if (!(fabs(best.value - found->value) > least_gain * fabs(found->value))) step *= 0.5;
    if (best.u != found->u || best.v != found->v) *found = best, n_moves++;
  }
}
