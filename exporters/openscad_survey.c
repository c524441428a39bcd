/* SPDX-License-Identifier: MIT */
/* Single role: what decides on triangles and walls of a surface: its box, how much it bends, and its radii of curvature.

   A point moved by d along the unit normal n, p + d n, stretches the principal directions by 1 - d k1 and 1 - d k2
   (curvatures positive where the surface bends towards n): the offset folds from d = 1 / k outwards for positive k, from
   d = 1 / |k| inwards for negative k. */
#include "openscad.h"
#include "base/base.h"
#include "math/diffgeo.h"
#include "math/vec3.h"

enum { N_CELLS = 8 };

static void survey_radius(const fs_geometry *geometry, const fs_vec3 *x, int32_t patch, fs_survey *survey) {
  fs_principal principal;
  double curvature[2];
  fs_geometry_principal(geometry, &principal);
  curvature[FS_INWARDS] = -principal.minimum;
  curvature[FS_OUTWARDS] = principal.maximum;
  for (int32_t i = 0; i < 2; i++)
    if (curvature[i] * survey->radius[i] > 1 || (curvature[i] > 0 && survey->patch[i] == FS_NONE)) {
      survey->radius[i] = 1 / curvature[i];
      survey->place[i] = x[FS_D];
      survey->patch[i] = patch;
    }
}

fs_status fs_survey_surface(fs_context *ctx, const fs_surface *surface, fs_survey *survey) {
  fs_survey s = {.min = {INFINITY, INFINITY, INFINITY},
                 .max = {-INFINITY, -INFINITY, -INFINITY},
                 .radius = {INFINITY, INFINITY},
                 .patch = {FS_NONE, FS_NONE}};
  fs_vec3 x[FS_JET_SIZE];
  fs_geometry geometry;
  for (int32_t p = 0; p < surface->n_patches; p++) {
    double uu = 0, uv = 0, vv = 0;
    for (int32_t k = 0; k < (N_CELLS + 1) * (N_CELLS + 1); k++) {
      double u = k % (N_CELLS + 1) / (double)N_CELLS, v = k / (N_CELLS + 1) / (double)N_CELLS;
      if (!fs_domain_holds(surface->patch[p].n_sides, u, v)) continue;
      fs_surface_evaluate(surface, p, u, v, x);
      if (!fs_vec3_is_finite(x[FS_D]))
        return fs_fail(ctx, FS_ERR_NUMERIC, "patch %d has points that are not finite", (int)p);
      s.min = fs_vec3_min(s.min, x[FS_D]);
      s.max = fs_vec3_max(s.max, x[FS_D]);
      if (!fs_geometry_compute(x, &geometry)) continue;
      uu = fmax(uu, fabs(geometry.h11));
      uv = fmax(uv, fabs(geometry.h12));
      vv = fmax(vv, fabs(geometry.h22));
      survey_radius(&geometry, x, p, &s);
    }
    s.bend = fmax(s.bend, uu + 2 * uv + vv);
  }
  *survey = s;
  return FS_OK;
}

double fs_survey_deviation(const fs_survey *survey, int32_t n_steps) {
  return survey->bend / (8.0 * n_steps * n_steps);
}
