/* SPDX-License-Identifier: MIT */
/* The table of measures: scalars that say how a surface bends at a point (formulas in math/diffgeo.c). */
#include <fairsurf/analyse.h>
#include "math/diffgeo.h"
#include "math/vec3.h"
#include <string.h>

static const fs_param no_params[] = {{0}};

static double mean(const double *param, const fs_vec3 *x) {
  fs_geometry g;
  (void)param;
  return fs_geometry_compute(x, &g) ? g.H : (double)NAN;
}

static double gaussian(const double *param, const fs_vec3 *x) {
  fs_geometry g;
  (void)param;
  return fs_geometry_compute(x, &g) ? g.K : (double)NAN;
}

static double gradient(const double *param, const fs_vec3 *x) {
  fs_geometry g;
  (void)param;
  return fs_geometry_compute(x, &g) ? fs_vec3_length(fs_geometry_mean_gradient(x, &g)) : (double)NAN;
}

static double maximum(const double *param, const fs_vec3 *x) {
  fs_geometry g;
  fs_principal principal;
  (void)param;
  if (!fs_geometry_compute(x, &g)) return NAN;
  fs_geometry_principal(&g, &principal);
  return principal.maximum;
}

static double minimum(const double *param, const fs_vec3 *x) {
  fs_geometry g;
  fs_principal principal;
  (void)param;
  if (!fs_geometry_compute(x, &g)) return NAN;
  fs_geometry_principal(&g, &principal);
  return principal.minimum;
}

#define MEASURE(name, summary, value) \
  { name, summary, no_params, value, NULL, NULL }
static const fs_measure table[] = {
    MEASURE("mean", "mean curvature (k1 + k2) / 2, positive where the surface bends to its outside", mean),
    MEASURE("gaussian", "Gaussian curvature k1 k2", gaussian),
    MEASURE("gradient", "length of the gradient of the mean curvature along the surface", gradient),
    MEASURE("maximum", "larger principal curvature", maximum),
    MEASURE("minimum", "smaller principal curvature", minimum),
};

const fs_measure *const fs_measures[] = {&table[0], &table[1], &table[2], &table[3], &table[4], NULL};

const fs_measure *fs_measure_find(const char *name) {
  for (const fs_measure *const *m = fs_measures; *m != NULL; m++)
    if (strcmp((*m)->name, name) == 0) return *m;
  return NULL;
}
